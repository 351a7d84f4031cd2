# SPDX-FileCopyrightText: The cusp authors
# SPDX-License-Identifier: Apache-2.0
# The DNC protocol written a second time, from docs/dnc-protocol.md alone: the witness that the page is enough.
import hashlib
import struct
import zlib

STATUS, OPEN, CHUNK, COMMIT, ARM = 1, 2, 3, 4, 5
IDLE, RECEIVING, VERIFIED, ARMED, FAILED = 0, 1, 2, 3, 7
STALE, HAD, GAP, WRONG_STATE, DIGEST, INCOMPLETE = 3, 4, 5, 7, 10, 20


def request(kind, tag, session, argument, payload=b""):
    head = struct.pack(">BBHIIH", kind, 1, tag, session, argument, len(payload))
    return head + struct.pack(">I", zlib.crc32(head + payload)) + payload


def read_request(data):
    """Kind, tag, session, argument, payload; nothing when the bytes are damaged."""
    if len(data) < 18:
        return None
    kind, _, tag, session, argument, length = struct.unpack(">BBHIIH", data[:14])
    payload = data[18 : 18 + length]
    if len(payload) != length or zlib.crc32(data[:14] + payload) != struct.unpack(">I", data[14:18])[0]:
        return None
    return kind, tag, session, argument, payload


def read_reply(data):
    magic, tag, state, reason, session, expected, free, crc, _, result, nonce, _ = struct.unpack(
        ">HHHHIIIIBBIH", data[:32]
    )
    if magic != 0xC501 or struct.unpack(">I", data[32:36])[0] != zlib.crc32(data[:32]):
        return None
    return {
        "tag": tag, "state": state, "reason": reason, "session": session, "expected": expected,
        "free": free, "crc": crc, "result": result, "nonce": nonce,
    }


class Control:
    """The least a control has to do: one program at a time, nothing held out of order."""

    def __init__(self):
        self.session, self.state, self.reason, self.tag = 77, IDLE, 0, 0
        self.nonce, self.result, self.opened = 0, 0, None
        self.program, self.length, self.digest, self.name = b"", 0, b"", ""

    def reply(self):
        free = self.length - len(self.program) if self.state == RECEIVING else 0
        head = struct.pack(
            ">HHHHIIIIBBIH", 0xC501, self.tag, self.state, self.reason, self.session, len(self.program),
            free, zlib.crc32(self.program), 0, self.result, self.nonce, 0,
        )
        status = bytes(52)
        return head + struct.pack(">I", zlib.crc32(head)) + status + struct.pack(">I", zlib.crc32(status))

    def handle(self, data):
        read = read_request(data)
        if read is None:
            self.reason = 1
            return self.reply()
        kind, self.tag, session, argument, payload = read
        self.reason = self.act(kind, session, argument, payload)
        return self.reply()

    def act(self, kind, session, argument, payload):
        if kind == OPEN:
            if self.opened == (session, argument):
                return 0
            if session != self.session:
                return STALE
            self.length, self.digest = struct.unpack(">I", payload[4:8])[0], payload[8:40]
            self.name = payload[52:].decode()
            self.opened = (session, argument)
            self.session += 1000003
            self.program, self.state, self.nonce, self.result = b"", RECEIVING, argument, 0
            return 0
        if kind not in (CHUNK, COMMIT, ARM):
            return 0
        if session != self.session:
            return STALE
        if kind == CHUNK:
            if argument + len(payload) <= len(self.program):
                return HAD
            if argument > len(self.program):
                return GAP
            self.program += payload[len(self.program) - argument :]
            return 0
        if argument <= self.nonce:
            return self.result if argument == self.nonce else 17
        self.nonce = argument
        self.result = self.commit() if kind == COMMIT else self.arm()
        return self.result

    def commit(self):
        if self.state != RECEIVING:
            return WRONG_STATE
        if len(self.program) != self.length:
            return INCOMPLETE
        if hashlib.sha256(self.program).digest() != self.digest:
            self.state = FAILED
            return DIGEST
        self.state = VERIFIED
        return 0

    def arm(self):
        if self.state != VERIFIED:
            return WRONG_STATE
        self.state = ARMED
        return 0


def send(program, name, exchange, chunk):
    """Sends over `exchange(request bytes) -> reply bytes`, one request at a time; returns the last reply."""
    tag = 1
    reply = read_reply(exchange(request(STATUS, tag, 0, 0)))
    header = struct.pack(">II", 99, len(program)) + hashlib.sha256(program).digest()
    header += struct.pack(">IIHH", program.count(b"\n"), 0, 0, len(name)) + name.encode()
    reply = read_reply(exchange(request(OPEN, 2, reply["session"], 5, header)))
    assert reply["result"] == 0 and reply["nonce"] == 5, reply
    session, tag = reply["session"], 3
    while reply["expected"] < len(program):
        at = reply["expected"]
        reply = read_reply(exchange(request(CHUNK, tag, session, at, program[at : at + chunk])))
        assert reply["tag"] == tag and reply["crc"] == zlib.crc32(program[: reply["expected"]]), reply
        tag += 1
    reply = read_reply(exchange(request(COMMIT, tag, session, 6)))
    assert reply["result"] == 0 and reply["state"] == VERIFIED, reply
    return reply
