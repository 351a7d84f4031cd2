# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# A control on Python's own CAN sockets (the kernel's ISO-TP): can_peer.py INTERFACE
import hashlib
import socket
import sys

from dnc_protocol import ARMED, Control

REQUESTS, REPLIES = 0x700, 0x701
control = Control()
bus = socket.socket(socket.AF_CAN, socket.SOCK_DGRAM, socket.CAN_ISOTP)
bus.bind((sys.argv[1], REQUESTS, REPLIES))
bus.settimeout(60)
print("ready", flush=True)
while control.state != ARMED:
    try:
        request = bus.recv(4096)
    except TimeoutError:
        raise
    except OSError:
        continue  # a message that got lost
    reply = control.handle(request)
    try:
        bus.send(reply)
    except OSError:
        continue
print("verified", hashlib.sha256(control.program).hexdigest(), flush=True)
