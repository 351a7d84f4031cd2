// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// PLY 1.0 (Turk 1994): a header in words, then elements as words or as bytes of either order.
#include "mesh_finish.hpp"
#include "ply_header.hpp"

#include <cusp/geometry/mesh_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cusp::geometry {
namespace {

using detail::PlyElement;
using detail::PlyFormat;
using detail::PlyHeader;
using detail::PlyProperty;
using detail::PlyType;

/// Values one after the other, whatever their form.
class ValueSource {
public:
    ValueSource(std::string_view body, const PlyHeader& header)
        : body_(body), format_(header.format), words_(body, header.lines + 1) {}

    /// Nothing at the end of the file or at a word that is no number.
    std::optional<double> read(PlyType type) {
        if (format_ == PlyFormat::Text) {
            const std::string_view word = words_.next();
            ended_ = word.empty();
            return base::parseDouble(word);
        }
        const std::size_t size = detail::sizeOf(type);
        if (body_.size() - at_ < size) {
            ended_ = true;
            return std::nullopt;
        }
        const char* const bytes = body_.data() + at_;
        at_ += size;
        return detail::valueOf(bytes, type, format_ == PlyFormat::BigEndian);
    }
    [[nodiscard]] bool ended() const { return ended_; }
    /// Of the value read last; 0 in a binary file.
    [[nodiscard]] std::size_t line() const { return format_ == PlyFormat::Text ? words_.line() : 0; }

private:
    std::string_view body_;
    PlyFormat format_;
    detail::MeshWords words_;
    std::size_t at_ = 0;
    bool ended_ = false;
};

class PlyReader {
public:
    PlyReader(std::string_view body, const PlyHeader& header, const std::string& file_name)
        : header_(header), values_(body, header), file_name_(file_name) {}

    base::Result<TriangleMesh> read() {
        for (const PlyElement& element : header_.elements) {
            for (std::size_t i = 0; i < element.count; ++i) {
                if (auto ok = readElement(element, i); !ok) return base::fail(std::move(ok).error());
            }
        }
        for (const TriangleMesh::Triangle& t : mesh_.triangles) {
            for (const std::uint32_t corner : t) {
                if (corner >= mesh_.vertices.size()) {
                    return detail::meshError(
                        "mesh.index",
                        fmt::format("a face names vertex {}; there are {}", corner, mesh_.vertices.size()), file_name_);
                }
            }
        }
        return std::move(mesh_);
    }

private:
    base::Result<void> readElement(const PlyElement& element, std::size_t index) {
        Vector3 point = Vector3::Zero();
        for (const PlyProperty& property : element.properties) {
            std::size_t count = 1;
            if (property.count_type) {
                const auto length = values_.read(*property.count_type);
                if (!length || !(*length >= 0.0 && *length <= 4294967295.0)) return problem(element, index);
                count = static_cast<std::size_t>(*length);
            }
            const bool corners = element.name == "face" && property.isCorners();
            corners_.clear();
            for (std::size_t k = 0; k < count; ++k) {
                const auto value = values_.read(property.type);
                if (!value) return problem(element, index);
                if (corners) corners_.push_back(*value);
                if (element.name == "vertex" && !property.count_type) property.putCoordinate(*value, point);
            }
            if (corners) {
                if (auto ok = addPolygon(index); !ok) return ok;
            }
        }
        if (element.name == "vertex") mesh_.vertices.push_back(point);
        return {};
    }

    base::Result<void> addPolygon(std::size_t index) {
        for (const double corner : corners_) {
            if (!(corner >= 0.0 && corner < 4294967295.0 && corner == std::floor(corner))) {
                return detail::meshError("mesh.index", fmt::format("face {} names a vertex {:g}", index, corner),
                                         file_name_, values_.line());
            }
        }
        if (corners_.size() < 3) {
            return detail::meshError("mesh.index", fmt::format("face {} has {} corners", index, corners_.size()),
                                     file_name_, values_.line());
        }
        for (std::size_t k = 2; k < corners_.size(); ++k) {
            mesh_.triangles.push_back({static_cast<std::uint32_t>(corners_[0]),
                                       static_cast<std::uint32_t>(corners_[k - 1]),
                                       static_cast<std::uint32_t>(corners_[k])});
        }
        return {};
    }

    tl::unexpected<base::Diagnostics> problem(const PlyElement& element, std::size_t index) const {
        if (values_.ended()) {
            return detail::meshError("mesh.truncated",
                                     fmt::format("the header announces {} of element '{}', the file ends after {}",
                                                 element.count, element.name, index),
                                     file_name_);
        }
        return detail::meshError("mesh.number",
                                 fmt::format("element '{}' {}: not a number that fits", element.name, index),
                                 file_name_, values_.line());
    }

    const PlyHeader& header_;
    ValueSource values_;
    const std::string& file_name_;
    TriangleMesh mesh_;
    std::vector<double> corners_;
};

}  // namespace

base::Result<TriangleMesh> readPly(std::string_view bytes, const std::string& file_name, base::Diagnostics& report) {
    const auto header = detail::readPlyHeader(bytes, file_name);
    if (!header) return base::fail(header.error());
    const auto mesh = PlyReader(bytes.substr(header->bytes), *header, file_name).read();
    if (!mesh) return mesh;
    return detail::finishMesh(*mesh, file_name, report);
}

}  // namespace cusp::geometry
