// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Any messages, chunks, moments and presses of keys for a control behind its receiver: no crash, and no start that nobody
// at the control has permitted.
#include <cusp/comm/controller/control_host.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

using namespace cusp::comm;

/// Bytes of the input, one after another; zeros behind its end.
class Input {
public:
    Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    [[nodiscard]] bool empty() const { return at_ >= size_; }
    std::uint8_t byte() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
    ByteView bytes(std::size_t most) {
        const std::size_t count = std::min(most, size_ - std::min(at_, size_));
        at_ += count;
        return {data_ + at_ - count, count};
    }

private:
    const std::uint8_t* data_;
    std::size_t size_;
    std::size_t at_ = 0;
};

struct Bench {
    Bench(const cusp::post::MachineFile& file, const cusp::kinematics::Machine& machine)
        : control(file, machine, {.look_ahead_blocks = 70, .wcs_origin_mm = {3000.0, 0.0, -700.0}}),
          host(control, {.memory_bytes = 1U << 20U}),
          receiver({}, host, 7) {}

    void say(Input& input) {
        RequestMessage message;
        message.type = static_cast<RequestType>(input.byte() % 11);
        message.reply_wanted = true;
        message.tag = ++tag;
        message.session = input.byte() % 8 == 0 ? input.byte() : receiver.session();
        const std::uint8_t kind = input.byte();
        message.argument = message.type == RequestType::Chunk ? receiver.acceptedBytes() + kind / 64U : ++nonce;
        Bytes payload;
        if (message.type == RequestType::Open) {
            ProgramHeader header;
            header.client = 1 + kind % 2U;
            const ByteView text = input.bytes(kind);
            header.length = static_cast<std::uint32_t>(std::max<std::size_t>(1, text.size()));
            header.digest = sha256(text);
            header.mode = kind % 3 == 0 ? TransferMode::Drip : TransferMode::Store;
            header.name = "P.MPF";
            payload = encode(header);
        } else {
            const ByteView bytes = input.bytes(kind);
            payload.assign(bytes.begin(), bytes.end());
        }
        message.payload = payload;
        static_cast<void>(receiver.handle(encode(message), now_s));
    }

    VirtualControl control;
    ControlHost host;
    Receiver receiver;
    double now_s = 1.0;
    std::uint16_t tag = 0;
    std::uint32_t nonce = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto file = cusp::post::readMachineFile(CUSP_SOURCE_DIR "/machines/fooke-endura-ca.toml");
    if (!file) std::abort();
    static const cusp::kinematics::Machine machine(file->machine);
    if (size > 4096) return 0;
    Bench bench(*file, machine);
    Input input(data, size);
    bool permitted = false;
    for (int step = 0; !input.empty() && step < 200; ++step) {
        const std::uint8_t what = input.byte();
        switch (what % 8) {
            case 0: static_cast<void>(bench.receiver.handle(input.bytes(input.byte()), bench.now_s)); break;
            case 5: bench.control.advance(0.02 * (what / 8)); break;
            case 6:
                if (what == 6) {
                    permitted = true;
                    bench.receiver.enableStart(bench.now_s, 60.0);
                } else if (what == 14) {
                    permitted = true;
                    static_cast<void>(bench.receiver.startLocally(bench.now_s));
                } else if (what == 22) {
                    bench.control.reset();
                    bench.receiver.reset(true);
                } else if (what == 30) {
                    bench.control.stop();
                }
                break;
            case 7: bench.now_s += what; break;
            default: bench.say(input);
        }
        bench.receiver.tick(bench.now_s);
        bench.host.follow(bench.receiver);
        if (!permitted && bench.control.status().state != ChannelState::Reset) std::abort();
    }
    bench.control.runToRest(1.0);
    return 0;
}
