// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The messages of the DNC protocol, as docs/dnc-protocol.md lays them out byte by byte.
#pragma once

#include <cusp/comm/link/bytes.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cusp::comm {

/// First register of every reply: 0xC5, then the version.
inline constexpr std::uint16_t protocol_magic = 0xC501;
inline constexpr std::size_t request_header_bytes = 18;
inline constexpr std::size_t acknowledgement_bytes = 36;
inline constexpr std::size_t status_bytes = 92;
inline constexpr std::size_t upload_header_bytes = acknowledgement_bytes + 14;
inline constexpr std::size_t max_payload_bytes = 8192;
inline constexpr std::size_t max_name_bytes = 32;

enum class RequestType : std::uint8_t {
    Status = 1,
    Open = 2,
    Chunk = 3,
    Commit = 4,
    Arm = 5,
    Start = 6,
    Abort = 7,
    Read = 8,
    Probe = 9,
};

/// Of the control's end. Programs may arrive in `Receiving`, and in drip mode in `Armed` and `Running` as well.
enum class ReceiverState : std::uint16_t {
    Idle = 0,
    Receiving = 1,
    Verified = 2,
    Armed = 3,
    Running = 4,
    Finished = 5,
    Interrupted = 6,
    Failed = 7,
};

/// Why a request had no effect, or not the whole one.
enum class Reason : std::uint16_t {
    None = 0,
    BadChecksum = 1,
    Malformed = 2,
    StaleSession = 3,
    AlreadyHad = 4,
    Gap = 5,
    Full = 6,
    WrongState = 7,
    Busy = 8,
    TooLong = 9,
    DigestDiffers = 10,
    NotAuthentic = 11,
    NotEnabled = 12,
    JumpsBackward = 13,
    LineTooLong = 14,
    Refused = 15,
    NotFound = 16,
    OldCommand = 17,
    TooFast = 18,
    Storage = 19,
    Incomplete = 20,
};

/// For people: "the control is busy with another sender".
[[nodiscard]] std::string_view toText(Reason reason);
[[nodiscard]] std::string_view toText(ReceiverState state);

struct RequestMessage {
    RequestType type = RequestType::Status;
    bool reply_wanted = true;
    std::uint16_t tag = 0;       ///< comes back in the reply
    std::uint32_t session = 0;   ///< 0: not known yet
    std::uint32_t argument = 0;  ///< byte offset of a chunk or a read; nonce of a command
    ByteView payload;            ///< a view of the bytes it was read from
};

[[nodiscard]] Bytes encode(const RequestMessage& message);

struct DecodedRequest {
    Reason reason = Reason::None;  ///< BadChecksum or Malformed: nothing else is to be trusted
    RequestMessage message;
};
[[nodiscard]] DecodedRequest decodeRequest(ByteView bytes);

using Digest = std::array<std::uint8_t, 32>;
[[nodiscard]] Digest sha256(ByteView bytes);
/// 64 lower-case hexadecimal digits, as `base::sha256Hex` writes them.
[[nodiscard]] std::string toHex(const Digest& digest);

enum class TransferMode : std::uint8_t {
    Store,  ///< the whole program first, then the start
    Drip,   ///< larger than the control's memory: runs while it comes
};

/// The payload of OPEN.
struct ProgramHeader {
    std::uint32_t client = 0;  ///< a number the sender chose for itself at random
    std::uint32_t length = 0;
    Digest digest{};
    std::uint32_t blocks = 0;
    std::uint32_t start_block = 0;  ///< of the whole program; not 0 when this is a resumed rest
    TransferMode mode = TransferMode::Store;
    bool jumps_backward = false;
    std::string name;  ///< "P.MPF": letters, digits, '_', '-', '.', not starting with a dot
};
[[nodiscard]] Bytes encode(const ProgramHeader& header);
[[nodiscard]] std::optional<ProgramHeader> decodeProgramHeader(ByteView payload);
/// A name that cannot leave the folder it is put in.
[[nodiscard]] bool isProgramName(std::string_view name);

/// The first part of every reply, the same for every request.
struct Acknowledgement {
    ReceiverState state = ReceiverState::Idle;
    Reason reason = Reason::None;  ///< of the request with this tag
    std::uint32_t session = 0;
    std::uint32_t expected = 0;     ///< offset of the first byte not yet accepted
    std::uint32_t free_bytes = 0;   ///< taken from `expected` on
    std::uint32_t running_crc = 0;  ///< CRC-32 of everything accepted in `session`
    std::uint16_t tag = 0;
    bool drip = false;
    bool start_enabled = false;
    bool key_demanded = false;
    bool prefilled = false;
    bool committed = false;
    std::uint32_t nonce = 0;               ///< of the last command
    Reason command_result = Reason::None;  ///< of the last command
    Reason failure = Reason::None;         ///< why the state is Failed
};
[[nodiscard]] Bytes encode(const Acknowledgement& acknowledgement);
/// Nothing when the bytes are too short, of another protocol, or broken.
[[nodiscard]] std::optional<Acknowledgement> decodeAcknowledgement(ByteView reply);

/// What the control tells about itself; the second part of the reply to Status and to commands.
struct MachineStatus {
    std::uint32_t alarm = 0;
    std::uint32_t executing_block = 0;
    std::uint32_t completed_block = 0;
    std::uint16_t queued_blocks = 0;
    std::uint16_t least_queued_blocks = 0;
    std::uint16_t starvations = 0;
    std::uint16_t override_permille = 0;
    std::uint16_t heartbeat = 0;
    std::uint16_t axis_count = 0;
    std::array<std::int32_t, 5> axes{};  ///< 0.1 µm and 1e-4 degree
    std::uint32_t resume_block = 0;      ///< where to resume after an interruption; 0: from the start
    std::uint32_t contact_ms = 0;        ///< time the tool stood in contact at the last starvation
};
[[nodiscard]] Bytes encode(const MachineStatus& status);
/// From a whole reply; nothing when it has no such part or that is broken.
[[nodiscard]] std::optional<MachineStatus> decodeMachineStatus(ByteView reply);

/// A piece of a program read back; the second part of the reply to Read.
struct UploadPiece {
    std::uint32_t offset = 0;
    std::uint32_t total = 0;
    ByteView bytes;
};
[[nodiscard]] Bytes encode(const UploadPiece& piece);
[[nodiscard]] std::optional<UploadPiece> decodeUploadPiece(ByteView reply);

/// HMAC-SHA256 (RFC 2104) that COMMIT carries when the control demands a key: over session, digest, length and name.
[[nodiscard]] Digest commitTag(std::string_view key, std::uint32_t session, const ProgramHeader& header);
/// In constant time.
[[nodiscard]] bool sameTag(ByteView a, ByteView b);

}  // namespace cusp::comm
