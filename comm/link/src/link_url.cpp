// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Taking a link's URL apart, and refusing what would be guessed at.
#include <cusp/comm/link/link_url.hpp>

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <optional>
#include <span>
#include <vector>

namespace cusp::comm {

namespace {

struct Key {
    std::string_view name;
    std::vector<std::string_view> values;  ///< allowed ones; empty: a number
    std::int64_t least = 0;
    std::int64_t most = 0;
};

struct Scheme {
    std::string_view name;
    LinkKind kind;
    bool device;  ///< a path, no host
    std::vector<Key> keys;
};

const std::vector<std::string_view>& parities() {
    static const std::vector<std::string_view> values{"N", "E", "O"};
    return values;
}

const std::vector<Scheme>& schemes() {
    static const Key baud{"baud", {}, 300, 4'000'000};
    static const Key parity{"parity", parities()};
    static const Key unit{"unit", {}, 1, 247};
    static const Key timeout{"timeout_ms", {}, 10, 60'000};
    static const Key send_id{"send_id", {}, 0, 0x7FF};
    static const Key receive_id{"receive_id", {}, 0, 0x7FF};
    static const std::vector<Scheme> all{
        {"tcp", LinkKind::Tcp, false, {}},
        {"serial", LinkKind::Serial, true, {baud, parity, {"flow", {"none", "xonxoff", "rtscts"}}}},
        {"modbus-tcp", LinkKind::ModbusTcp, false, {unit, {"connections", {}, 1, 16}, timeout}},
        {"modbus-rtu", LinkKind::ModbusRtu, true, {baud, parity, unit, timeout}},
        {"can",
         LinkKind::Can,
         false,
         {send_id, receive_id, {"fd", {"0", "1"}}, {"transport", {"auto", "kernel", "own"}}}},
        {"file", LinkKind::File, true, {}}};
    return all;
}

/// Decimal, or hexadecimal with 0x: CAN identifiers are written so.
std::optional<std::int64_t> parseNumber(std::string_view text) {
    if (!text.starts_with("0x")) return base::parseInteger(text);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), value, 16);
    if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
    return value;
}

base::Result<void> checkParameter(const Scheme& scheme, const std::string& name, const std::string& value) {
    const auto key = std::ranges::find(scheme.keys, name, &Key::name);
    if (key == scheme.keys.end()) {
        std::vector<std::string_view> names;
        for (const Key& known : scheme.keys) names.push_back(known.name);
        return base::fail("link.url", names.empty()
                                          ? fmt::format("{}:// takes no parameters, and '{}' is one", scheme.name, name)
                                          : fmt::format("{}:// has no parameter '{}': it takes {}", scheme.name, name,
                                                        fmt::join(names, ", ")));
    }
    if (!key->values.empty()) {
        if (std::ranges::find(key->values, value) != key->values.end()) return {};
        return base::fail("link.url", fmt::format("'{}' is no {}: {}", value, name, fmt::join(key->values, ", ")));
    }
    const auto number = parseNumber(value);
    if (number && *number >= key->least && *number <= key->most) return {};
    return base::fail("link.url",
                      fmt::format("'{}' is no {}: a number from {} to {}", value, name, key->least, key->most));
}

base::Result<void> readParameters(const Scheme& scheme, std::string_view query, LinkUrl& url) {
    while (!query.empty()) {
        const std::size_t end = std::min(query.find('&'), query.size());
        const std::string_view pair = query.substr(0, end);
        query.remove_prefix(std::min(end + 1, query.size()));
        const std::size_t equals = pair.find('=');
        if (equals == std::string_view::npos)
            return base::fail("link.url", fmt::format("'{}' is no parameter: key=value", pair));
        const std::string name(pair.substr(0, equals));
        const std::string value(pair.substr(equals + 1));
        if (auto checked = checkParameter(scheme, name, value); !checked) return checked;
        if (!url.parameters.emplace(name, value).second)
            return base::fail("link.url", fmt::format("'{}' is given twice", name));
    }
    return {};
}

base::Result<void> readHost(std::string_view authority, LinkUrl& url) {
    const std::size_t colon = authority.rfind(':');
    if (url.kind == LinkKind::Can) {
        url.host = std::string(authority);
        if (url.host.empty() || url.host.size() > 15)
            return base::fail("link.url", "names no CAN interface: can://can0");
        return {};
    }
    const auto port = colon == std::string_view::npos ? std::nullopt : base::parseInteger(authority.substr(colon + 1));
    if (!port || *port < 0 || *port > 65535) return base::fail("link.url", "names no port: tcp://192.168.0.10:5000");
    url.port = static_cast<std::uint16_t>(*port);
    url.host = std::string(authority.substr(0, colon));
    if (url.host.starts_with('[') && url.host.ends_with(']')) url.host = url.host.substr(1, url.host.size() - 2);
    if (url.host.empty()) return base::fail("link.url", "names no host: tcp://192.168.0.10:5000");
    return {};
}

base::Result<LinkUrl> parse(std::string_view text) {
    const std::size_t colon = text.find("://");
    const std::string_view name = text.substr(0, std::min(colon, text.size()));
    const auto scheme = std::ranges::find(schemes(), name, &Scheme::name);
    if (colon == std::string_view::npos || scheme == schemes().end())
        return base::fail("link.url",
                          "begins with none of tcp://, serial://, modbus-tcp://, modbus-rtu://, can://, file://");
    LinkUrl url;
    url.kind = scheme->kind;
    url.text = std::string(text);
    std::string_view rest = text.substr(colon + 3);
    const std::size_t question = std::min(rest.find('?'), rest.size());
    const std::string_view query = rest.substr(std::min(question + 1, rest.size()));
    rest = rest.substr(0, question);
    if (scheme->device) {
        if (!rest.starts_with('/') || rest.size() < 2)
            return base::fail("link.url", fmt::format("names no path: {}:///absolute/path", scheme->name));
        url.path = std::string(rest);
    } else {
        if (rest.ends_with('/')) rest.remove_suffix(1);
        if (auto read = readHost(rest, url); !read) return base::fail(std::move(read).error());
    }
    if (auto read = readParameters(*scheme, query, url); !read) return base::fail(std::move(read).error());
    return url;
}

}  // namespace

std::string LinkUrl::parameter(const std::string& key, const std::string& otherwise) const {
    const auto found = parameters.find(key);
    return found == parameters.end() ? otherwise : found->second;
}

std::int64_t LinkUrl::number(const std::string& key, std::int64_t otherwise) const {
    const auto found = parameters.find(key);
    return found == parameters.end() ? otherwise : parseNumber(found->second).value_or(otherwise);
}

base::Result<LinkUrl> parseLinkUrl(std::string_view text) {
    auto url = parse(text);
    if (url) return url;
    // The URL itself is where the problem lies.
    base::Diagnostic diagnostic = url.error().front();
    diagnostic.where.key = std::string(text);
    base::Diagnostics out;
    out.add(std::move(diagnostic));
    return base::fail(std::move(out));
}

}  // namespace cusp::comm
