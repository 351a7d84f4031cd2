// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Serial devices in raw mode: RS-232 with XON/XOFF, RTS/CTS or no flow control.
#include "file_descriptor.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <termios.h>

namespace cusp::comm {

namespace {

struct BaudRate {
    std::int64_t baud;
    speed_t code;
};
constexpr std::array<BaudRate, 13> baud_rates{{{300, B300},
                                               {600, B600},
                                               {1200, B1200},
                                               {2400, B2400},
                                               {4800, B4800},
                                               {9600, B9600},
                                               {19200, B19200},
                                               {38400, B38400},
                                               {57600, B57600},
                                               {115200, B115200},
                                               {230400, B230400},
                                               {460800, B460800},
                                               {921600, B921600}}};

void setFraming(termios& settings, const LinkUrl& url) {
    ::cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB | PARENB | PARODD);
    const std::string parity = url.parameter("parity", "N");
    if (parity != "N") settings.c_cflag |= PARENB;
    if (parity == "O") settings.c_cflag |= PARODD;
    const std::string flow = url.parameter("flow", "none");
    if (flow == "rtscts") settings.c_cflag |= CRTSCTS;
    if (flow == "xonxoff") {
        settings.c_iflag |= IXON | IXOFF;
        settings.c_cc[VSTART] = 0x11;
        settings.c_cc[VSTOP] = 0x13;
    }
    settings.c_cc[VMIN] = 1;  // nothing there is EAGAIN then, and 0 bytes mean a hangup
    settings.c_cc[VTIME] = 0;
}

}  // namespace

base::Result<FileDescriptor> openSerial(const LinkUrl& url) {
    const std::int64_t baud = url.number("baud", 115200);
    const auto rate = std::ranges::find(baud_rates, baud, &BaudRate::baud);
    if (rate == baud_rates.end())
        return base::fail("link.url", fmt::format("{} baud is no rate serial devices have", baud),
                          {url.text, 0, 0, {}});
    FileDescriptor device(::open(url.path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    if (!device.open()) return failOpen(url.text, errno);
    termios settings{};
    if (::tcgetattr(device.get(), &settings) != 0) return failOpen(url.text, errno);
    setFraming(settings, url);
    ::cfsetispeed(&settings, rate->code);
    ::cfsetospeed(&settings, rate->code);
    if (::tcsetattr(device.get(), TCSANOW, &settings) != 0) return failOpen(url.text, errno);
    ::tcflush(device.get(), TCIOFLUSH);
    return device;
}

}  // namespace cusp::comm
