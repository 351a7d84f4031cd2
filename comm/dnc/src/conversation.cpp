// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tags, round trips, and commands sent again until they are answered.
#include <cusp/comm/dnc/conversation.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::comm {

namespace {
constexpr double gain = 1.0 / 8.0;
constexpr double variance_gain = 1.0 / 4.0;
constexpr double variance_factor = 4.0;
}  // namespace

RoundTrip::RoundTrip(double initial_s, double least_s, double most_s)
    : least_s_(least_s), most_s_(most_s), base_s_(initial_s) {}

void RoundTrip::sample(double round_trip_s) {
    if (!sampled_) {
        sampled_ = true;
        smoothed_s_ = round_trip_s;
        variance_s_ = round_trip_s / 2.0;
    } else {
        variance_s_ += variance_gain * (std::abs(smoothed_s_ - round_trip_s) - variance_s_);
        smoothed_s_ += gain * (round_trip_s - smoothed_s_);
    }
    base_s_ = smoothed_s_ + (variance_factor * variance_s_);
}

void RoundTrip::backOff() { backoff_ = std::min(backoff_ * 2.0, 64.0); }

double RoundTrip::timeoutSeconds() const { return std::min(most_s_, std::max(least_s_, base_s_) * backoff_); }

Request Conversation::make(RequestType type, std::uint32_t argument, ByteView payload, bool reply_wanted,
                           double now_s) {
    const std::uint16_t tag = next_tag_++;
    // Tags wrap around; the window of those believed never covers more than half of them.
    if (static_cast<std::uint16_t>(next_tag_ - first_tag_) > half_of_all_tags)
        first_tag_ = static_cast<std::uint16_t>(next_tag_ - half_of_all_tags);
    if (reply_wanted) sent_[tag % remembered] = {tag, argument, now_s};
    Request out;
    out.bytes = encode(RequestMessage{type, reply_wanted, tag, session_, argument, payload});
    out.reply_wanted = reply_wanted;
    const bool brief = type == RequestType::Chunk || type == RequestType::Probe;
    out.reply_bytes = brief ? acknowledgement_bytes : status_bytes;
    if (type == RequestType::Read) {
        out.area = ReplyArea::Upload;
        out.reply_bytes = upload_header_bytes + get16(payload, 0);
    }
    return out;
}

std::optional<Acknowledgement> Conversation::accept(ByteView reply, double now_s) {
    const auto acknowledgement = decodeAcknowledgement(reply);
    if (!acknowledgement) {
        ++damaged_;
        return std::nullopt;
    }
    const auto age = static_cast<std::uint16_t>(acknowledgement->tag - first_tag_);
    if (age >= static_cast<std::uint16_t>(next_tag_ - first_tag_)) return std::nullopt;
    Sent& sent = sent_[acknowledgement->tag % remembered];
    if (sent.tag == acknowledgement->tag && sent.at_s >= 0.0) {
        round_trip_.sample(now_s - sent.at_s);
        sent.at_s = -1.0;
    }
    last_heard_s_ = now_s;
    return acknowledgement;
}

std::optional<std::uint32_t> Conversation::argumentOf(std::uint16_t tag) const {
    const Sent& sent = sent_[tag % remembered];
    return sent.tag == tag ? std::optional(sent.argument) : std::nullopt;
}

void Conversation::enter(std::uint32_t session) {
    session_ = session;
    first_tag_ = next_tag_;
}

std::optional<Request> Exchange::poll(Conversation& conversation, double now_s) {
    if (now_s < nextAtSeconds(conversation)) return std::nullopt;
    if (tries > 0) conversation.roundTrip().backOff();
    ++tries;
    sent_s = now_s;
    return conversation.make(type, argument, payload, true, now_s);
}

double Exchange::nextAtSeconds(const Conversation& conversation) const {
    return sent_s < 0.0 ? not_before_s : sent_s + conversation.roundTrip().timeoutSeconds();
}

}  // namespace cusp::comm
