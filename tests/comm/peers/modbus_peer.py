# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# An independent Modbus peer (pymodbus) that speaks the DNC protocol, as a sender and as a control.
#   modbus_peer.py send tcp:PORT|rtu:DEVICE FILE NAME
#   modbus_peer.py control tcp:PORT|rtu:DEVICE FILE      writes what was committed to FILE, then ends
import asyncio
import logging
import sys

from dnc_protocol import ARMED, Control, send
from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server.async_io import ModbusSerialServer, ModbusTcpServer
from pymodbus.transaction import ModbusRtuFramer, ModbusSocketFramer

MAILBOX = 0x200


def to_registers(data):
    data += bytes(len(data) % 2)
    return [data[i] << 8 | data[i + 1] for i in range(0, len(data), 2)]


def to_bytes(registers):
    return b"".join(value.to_bytes(2, "big") for value in registers)


def send_program(link, path, name):
    tcp = link.startswith("tcp:")
    if tcp:
        client = ModbusTcpClient("127.0.0.1", port=int(link[4:]))
    else:
        client = ModbusSerialClient(link[4:], framer=ModbusRtuFramer, baudrate=115200, timeout=2)
    assert client.connect()

    def exchange(request):
        if tcp:
            answer = client.readwrite_registers(
                read_address=0, read_count=18, write_address=MAILBOX, write_registers=to_registers(request), slave=1
            )
        else:
            assert not client.write_registers(MAILBOX, to_registers(request), slave=1).isError()
            answer = client.read_holding_registers(0, 18, slave=1)
        assert not answer.isError(), answer
        return to_bytes(answer.registers)

    with open(path, "rb") as file:
        send(file.read(), name, exchange, 220)
    client.close()
    print("verified")


class Registers(ModbusSequentialDataBlock):
    """The register map: what is written to the mailbox goes to the control, its reply lies at 0."""

    def __init__(self, control, done):
        super().__init__(0, [0] * 0x400)
        self.control, self.done = control, done
        self.show()

    def show(self):
        super().setValues(0, to_registers(self.control.reply()))

    def setValues(self, address, values):  # noqa: N802, the name is pymodbus's
        assert address == MAILBOX, address
        self.control.handle(to_bytes(values))
        self.show()
        if self.control.state == ARMED:
            self.done()


async def serve(link, path):
    control = Control()
    over = asyncio.Event()
    registers = Registers(control, over.set)
    context = ModbusServerContext(ModbusSlaveContext(hr=registers, zero_mode=True), single=True)
    if link.startswith("tcp:"):
        server = ModbusTcpServer(context, framer=ModbusSocketFramer, address=("127.0.0.1", int(link[4:])),
                                 allow_reuse_address=True)
    else:
        server = ModbusSerialServer(context, framer=ModbusRtuFramer, port=link[4:], baudrate=115200)
        await server.start()
    task = asyncio.ensure_future(server.serve_forever())
    if link.startswith("tcp:"):
        await server.serving
    print("ready", flush=True)
    await asyncio.wait_for(over.wait(), 60)
    with open(path, "wb") as file:
        file.write(control.program)
    # The reply to ARM is on its way still.
    await asyncio.sleep(0.5)
    task.cancel()
    print("verified", control.name, flush=True)


if __name__ == "__main__":
    # It calls the end of its own connections an error.
    logging.disable(logging.CRITICAL)
    if sys.argv[1] == "send":
        send_program(*sys.argv[2:])
    else:
        asyncio.run(serve(*sys.argv[2:]))
