// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Messages to bytes and back; every number is big-endian, every part carries its own CRC-32.
#include <cusp/comm/dnc/message.hpp>

#include <cusp/base/hash.hpp>

#include <algorithm>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

namespace cusp::comm {

namespace {

constexpr std::uint8_t flag_reply_wanted = 0x01;
constexpr std::size_t request_crc_at = 14;
constexpr std::size_t acknowledgement_crc_at = acknowledgement_bytes - 4;
constexpr std::size_t open_fixed_bytes = 52;

constexpr std::uint16_t flag_drip = 0x01;
constexpr std::uint16_t flag_start_enabled = 0x02;
constexpr std::uint16_t flag_key_demanded = 0x04;
constexpr std::uint16_t flag_prefilled = 0x08;
constexpr std::uint16_t flag_committed = 0x10;
constexpr std::uint16_t open_drip = 0x01;
constexpr std::uint16_t open_jumps_backward = 0x02;

Digest digestAt(ByteView bytes, std::size_t at) {
    Digest digest{};
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), digest.size(), digest.begin());
    return digest;
}

bool isRequestType(std::uint8_t value) {
    return value >= static_cast<std::uint8_t>(RequestType::Status) &&
           value <= static_cast<std::uint8_t>(RequestType::Probe);
}

}  // namespace

Bytes encode(const RequestMessage& message) {
    Bytes out;
    out.reserve(request_header_bytes + message.payload.size());
    out.push_back(static_cast<std::uint8_t>(message.type));
    out.push_back(message.reply_wanted ? flag_reply_wanted : 0);
    put16(out, message.tag);
    put32(out, message.session);
    put32(out, message.argument);
    put16(out, static_cast<std::uint32_t>(message.payload.size()));
    put32(out, base::crc32(message.payload, base::crc32(ByteView(out))));
    append(out, message.payload);
    return out;
}

DecodedRequest decodeRequest(ByteView bytes) {
    DecodedRequest out;
    if (bytes.size() < request_header_bytes) {
        out.reason = Reason::Malformed;
        return out;
    }
    const std::size_t length = get16(bytes, 12);
    if (length > max_payload_bytes || bytes.size() < request_header_bytes + length) {
        out.reason = Reason::Malformed;
        return out;
    }
    // Registers come in pairs of bytes, CAN FD frames in steps: what follows the payload is padding.
    const ByteView payload = bytes.subspan(request_header_bytes, length);
    const std::uint32_t crc = base::crc32(payload, base::crc32(bytes.first(request_crc_at)));
    if (crc != get32(bytes, request_crc_at)) {
        out.reason = Reason::BadChecksum;
        return out;
    }
    if (!isRequestType(bytes[0]) || (bytes[1] & ~flag_reply_wanted) != 0) {
        out.reason = Reason::Malformed;
        return out;
    }
    out.message = {static_cast<RequestType>(bytes[0]),
                   bytes[1] == flag_reply_wanted,
                   get16(bytes, 2),
                   get32(bytes, 4),
                   get32(bytes, 8),
                   payload};
    return out;
}

Digest sha256(ByteView bytes) {
    Digest digest{};
    // Fails only when memory runs out; an empty digest then matches no program.
    static_cast<void>(EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, EVP_sha256(), nullptr));
    return digest;
}

std::string toHex(const Digest& digest) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string out;
    for (const std::uint8_t byte : digest) {
        out += digits[byte >> 4U];
        out += digits[byte & 0xFU];
    }
    return out;
}

bool isProgramName(std::string_view name) {
    if (name.empty() || name.size() > max_name_bytes || name.front() == '.') return false;
    return std::ranges::all_of(name, [](char c) {
        return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
               c == '.';
    });
}

Bytes encode(const ProgramHeader& header) {
    Bytes out;
    put32(out, header.client);
    put32(out, header.length);
    append(out, header.digest);
    put32(out, header.blocks);
    put32(out, header.start_block);
    put16(out, (header.mode == TransferMode::Drip ? std::uint32_t{open_drip} : 0U) |
                   (header.jumps_backward ? std::uint32_t{open_jumps_backward} : 0U));
    put16(out, static_cast<std::uint32_t>(header.name.size()));
    append(out, bytesOf(header.name));
    return out;
}

std::optional<ProgramHeader> decodeProgramHeader(ByteView payload) {
    if (payload.size() < open_fixed_bytes) return std::nullopt;
    const std::uint16_t flags = get16(payload, 48);
    const std::size_t name_bytes = get16(payload, 50);
    if ((flags & ~(open_drip | open_jumps_backward)) != 0 || payload.size() != open_fixed_bytes + name_bytes)
        return std::nullopt;
    ProgramHeader header;
    header.client = get32(payload, 0);
    header.length = get32(payload, 4);
    header.digest = digestAt(payload, 8);
    header.blocks = get32(payload, 40);
    header.start_block = get32(payload, 44);
    header.mode = (flags & open_drip) != 0 ? TransferMode::Drip : TransferMode::Store;
    header.jumps_backward = (flags & open_jumps_backward) != 0;
    header.name = textOf(payload.subspan(open_fixed_bytes));
    if (!isProgramName(header.name)) return std::nullopt;
    return header;
}

Bytes encode(const Acknowledgement& acknowledgement) {
    Bytes out;
    out.reserve(status_bytes);
    put16(out, protocol_magic);
    put16(out, acknowledgement.tag);
    put16(out, static_cast<std::uint16_t>(acknowledgement.state));
    put16(out, static_cast<std::uint16_t>(acknowledgement.reason));
    put32(out, acknowledgement.session);
    put32(out, acknowledgement.expected);
    put32(out, acknowledgement.free_bytes);
    put32(out, acknowledgement.running_crc);
    std::uint32_t flags = 0;
    if (acknowledgement.drip) flags |= flag_drip;
    if (acknowledgement.start_enabled) flags |= flag_start_enabled;
    if (acknowledgement.key_demanded) flags |= flag_key_demanded;
    if (acknowledgement.prefilled) flags |= flag_prefilled;
    if (acknowledgement.committed) flags |= flag_committed;
    out.push_back(static_cast<std::uint8_t>(flags));
    out.push_back(static_cast<std::uint8_t>(acknowledgement.command_result));
    put32(out, acknowledgement.nonce);
    put16(out, static_cast<std::uint16_t>(acknowledgement.failure));
    put32(out, base::crc32(ByteView(out)));
    return out;
}

std::optional<Acknowledgement> decodeAcknowledgement(ByteView reply) {
    if (reply.size() < acknowledgement_bytes || get16(reply, 0) != protocol_magic ||
        get32(reply, acknowledgement_crc_at) != base::crc32(reply.first(acknowledgement_crc_at)))
        return std::nullopt;
    Acknowledgement out;
    out.tag = get16(reply, 2);
    out.state = static_cast<ReceiverState>(get16(reply, 4));
    out.reason = static_cast<Reason>(get16(reply, 6));
    out.session = get32(reply, 8);
    out.expected = get32(reply, 12);
    out.free_bytes = get32(reply, 16);
    out.running_crc = get32(reply, 20);
    const std::uint8_t flags = reply[24];
    out.drip = (flags & flag_drip) != 0;
    out.start_enabled = (flags & flag_start_enabled) != 0;
    out.key_demanded = (flags & flag_key_demanded) != 0;
    out.prefilled = (flags & flag_prefilled) != 0;
    out.committed = (flags & flag_committed) != 0;
    out.command_result = static_cast<Reason>(reply[25]);
    out.nonce = get32(reply, 26);
    out.failure = static_cast<Reason>(get16(reply, 30));
    return out;
}

Bytes encode(const MachineStatus& status) {
    Bytes out;
    put32(out, status.alarm);
    put32(out, status.executing_block);
    put32(out, status.completed_block);
    put16(out, status.queued_blocks);
    put16(out, status.least_queued_blocks);
    put16(out, status.starvations);
    put16(out, status.override_permille);
    put16(out, status.heartbeat);
    put16(out, status.axis_count);
    for (const std::int32_t axis : status.axes) put32(out, static_cast<std::uint32_t>(axis));
    put32(out, status.resume_block);
    put32(out, status.contact_ms);
    put32(out, base::crc32(ByteView(out)));
    return out;
}

std::optional<MachineStatus> decodeMachineStatus(ByteView reply) {
    if (reply.size() < status_bytes) return std::nullopt;
    const ByteView part = reply.subspan(acknowledgement_bytes, status_bytes - acknowledgement_bytes);
    const std::size_t crc_at = part.size() - 4;
    if (get32(part, crc_at) != base::crc32(part.first(crc_at))) return std::nullopt;
    MachineStatus out;
    out.alarm = get32(part, 0);
    out.executing_block = get32(part, 4);
    out.completed_block = get32(part, 8);
    out.queued_blocks = get16(part, 12);
    out.least_queued_blocks = get16(part, 14);
    out.starvations = get16(part, 16);
    out.override_permille = get16(part, 18);
    out.heartbeat = get16(part, 20);
    out.axis_count = get16(part, 22);
    for (std::size_t i = 0; i < out.axes.size(); ++i)
        out.axes[i] = static_cast<std::int32_t>(get32(part, 24 + (4 * i)));
    out.resume_block = get32(part, 44);
    out.contact_ms = get32(part, 48);
    return out;
}

Bytes encode(const UploadPiece& piece) {
    Bytes out;
    put32(out, piece.offset);
    put16(out, static_cast<std::uint32_t>(piece.bytes.size()));
    put32(out, piece.total);
    put32(out, base::crc32(piece.bytes, base::crc32(ByteView(out))));
    append(out, piece.bytes);
    return out;
}

std::optional<UploadPiece> decodeUploadPiece(ByteView reply) {
    if (reply.size() < upload_header_bytes) return std::nullopt;
    const ByteView part = reply.subspan(acknowledgement_bytes);
    const std::size_t length = get16(part, 4);
    constexpr std::size_t header = upload_header_bytes - acknowledgement_bytes;
    if (part.size() < header + length) return std::nullopt;
    const ByteView bytes = part.subspan(header, length);
    if (get32(part, 10) != base::crc32(bytes, base::crc32(part.first(10)))) return std::nullopt;
    return UploadPiece{get32(part, 0), get32(part, 6), bytes};
}

Digest commitTag(std::string_view key, std::uint32_t session, const ProgramHeader& header) {
    Bytes signed_bytes = bytesOf("cusp-dnc commit");
    put32(signed_bytes, session);
    put32(signed_bytes, header.length);
    append(signed_bytes, header.digest);
    append(signed_bytes, bytesOf(header.name));
    Digest tag{};
    unsigned int size = 0;
    HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()), signed_bytes.data(), signed_bytes.size(), tag.data(),
         &size);
    return tag;
}

bool sameTag(ByteView a, ByteView b) {
    return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace cusp::comm
