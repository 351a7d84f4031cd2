// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reasons and states in words.
#include <cusp/comm/dnc/message.hpp>

namespace cusp::comm {

std::string_view toText(Reason reason) {
    switch (reason) {
        case Reason::None: return "done";
        case Reason::BadChecksum: return "the message arrived damaged";
        case Reason::Malformed: return "the control does not understand the message";
        case Reason::StaleSession: return "the message belongs to a session that is over";
        case Reason::AlreadyHad: return "the control already has these bytes";
        case Reason::Gap: return "bytes before these are missing";
        case Reason::Full: return "the control has no room just now";
        case Reason::WrongState: return "the control is in no state to do this";
        case Reason::Busy: return "the control is busy with another sender";
        case Reason::TooLong: return "the program is longer than the control accepts";
        case Reason::DigestDiffers: return "what arrived is not the program that was announced";
        case Reason::NotAuthentic: return "the control demands a key, and this was not signed with it";
        case Reason::NotEnabled: return "the start is not enabled at the control";
        case Reason::JumpsBackward: return "a program that jumps backward cannot be drip-fed";
        case Reason::LineTooLong: return "a line is longer than the control accepts";
        case Reason::Refused: return "the control refuses the program";
        case Reason::NotFound: return "the control has no such program";
        case Reason::OldCommand: return "the command came too late, after a later one";
        case Reason::TooFast: return "more bytes a second than the control accepts";
        case Reason::Storage: return "the control could not store the program";
        case Reason::Incomplete: return "the program has not arrived whole";
    }
    return "a reason this version does not know";
}

std::string_view toText(ReceiverState state) {
    switch (state) {
        case ReceiverState::Idle: return "idle";
        case ReceiverState::Receiving: return "receiving";
        case ReceiverState::Verified: return "verified";
        case ReceiverState::Armed: return "armed";
        case ReceiverState::Running: return "running";
        case ReceiverState::Finished: return "finished";
        case ReceiverState::Interrupted: return "interrupted";
        case ReceiverState::Failed: return "failed";
    }
    return "a state this version does not know";
}

}  // namespace cusp::comm
