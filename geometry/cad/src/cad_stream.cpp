// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One walk over the model both ways: what writes a value is what reads it.
#include "cad_stream.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

namespace cusp::geometry::cad {
namespace {

constexpr std::string_view magic = "CUSPCAD1";

class Writer {
public:
    Writer() : bytes_(magic) {}
    void number(double& value) { put(&value); }
    void count(std::size_t& value, std::size_t /*bytes_each*/) {
        auto wide = static_cast<std::int64_t>(value);
        put(&wide);
    }
    [[nodiscard]] std::string take() { return std::move(bytes_) + std::string(magic); }
    [[nodiscard]] bool failed() const { return false; }

private:
    template <class T>
    void put(const T* value) {
        std::array<char, sizeof(T)> raw{};
        std::memcpy(raw.data(), value, sizeof(T));
        bytes_.append(raw.data(), raw.size());
    }
    std::string bytes_;
};

/// Gives zeros once something did not fit.
class Reader {
public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) { failed_ = !takeMagic(); }
    void number(double& value) { get(value); }
    /// A count of things that take at least `bytes_each`: more than the rest can hold is a failure, not an allocation.
    void count(std::size_t& value, std::size_t bytes_each) {
        std::int64_t wide = 0;
        get(wide);
        if (wide < 0 || static_cast<std::uint64_t>(wide) > bytes_.size() / bytes_each) failed_ = true;
        value = failed_ ? 0 : static_cast<std::size_t>(wide);
    }
    [[nodiscard]] bool finished() { return !failed_ && takeMagic() && bytes_.empty(); }
    [[nodiscard]] bool failed() const { return failed_; }

private:
    bool takeMagic() {
        if (!bytes_.starts_with(magic)) return false;
        bytes_.remove_prefix(magic.size());
        return true;
    }
    template <class T>
    void get(T& value) {
        if (failed_ || bytes_.size() < sizeof(T)) {
            failed_ = true;
            value = T{};
            return;
        }
        std::memcpy(&value, bytes_.data(), sizeof(T));
        bytes_.remove_prefix(sizeof(T));
    }
    std::string_view bytes_;
    bool failed_ = false;
};

template <class Stream>
void walk(Stream& stream, std::vector<double>& values) {
    std::size_t count = values.size();
    stream.count(count, sizeof(double));
    values.resize(count);
    for (double& value : values) stream.number(value);
}

template <class Stream>
void walk(Stream& stream, std::vector<Vector3>& points) {
    std::size_t count = points.size();
    stream.count(count, sizeof(Vector3));
    points.resize(count);
    for (Vector3& point : points) {
        for (double& x : point) stream.number(x);
    }
}

template <class Stream>
void walkDegree(Stream& stream, int& degree) {
    auto wide = static_cast<double>(degree);
    stream.number(wide);
    degree = wide >= 0.0 && wide <= 1000.0 ? static_cast<int>(wide) : 0;
}

template <class Stream>
void walkFlag(Stream& stream, bool& flag) {
    double value = flag ? 1.0 : 0.0;
    stream.number(value);
    flag = value != 0.0;
}

template <class Stream, class Row>
void walkRows(Stream& stream, std::vector<Row>& rows) {
    std::size_t count = rows.size();
    stream.count(count, sizeof(std::int64_t));
    rows.resize(count);
    for (Row& row : rows) walk(stream, row);
}

template <class Stream>
void walk(Stream& stream, BSplineCurveForm& curve) {
    walkDegree(stream, curve.degree);
    walk(stream, curve.knots);
    walk(stream, curve.points);
    walk(stream, curve.weights);
}

template <class Stream>
void walk(Stream& stream, CadModel& model) {
    std::size_t faces = model.faces.size();
    stream.count(faces, 64);
    model.faces.resize(faces);
    for (StreamedFace& face : model.faces) {
        walkDegree(stream, face.surface.degree_u);
        walkDegree(stream, face.surface.degree_v);
        walk(stream, face.surface.knots_u);
        walk(stream, face.surface.knots_v);
        walkRows(stream, face.surface.points);
        walkRows(stream, face.surface.weights);
        walkFlag(stream, face.reversed);
    }
    std::size_t edges = model.edges.size();
    stream.count(edges, 32);
    model.edges.resize(edges);
    for (StreamedEdge& edge : model.edges) {
        walkFlag(stream, edge.is_point);
        walk(stream, edge.curve);
        std::size_t uses = edge.uses.size();
        stream.count(uses, 32);
        edge.uses.resize(uses);
        for (StreamedUse& use : edge.uses) {
            auto face = static_cast<double>(use.face);
            stream.number(face);
            use.face = face >= 0.0 && face < 1e15 ? static_cast<std::size_t>(face) : static_cast<std::size_t>(-1);
            walk(stream, use.parameters);
        }
        if (stream.failed()) return;
    }
}

}  // namespace

std::string toStream(const CadModel& model) {
    Writer writer;
    CadModel copy = model;  // the walk is one for both ways, and reading changes the model
    walk(writer, copy);
    return writer.take();
}

base::Result<CadModel> fromStream(std::string_view bytes, const std::string& file_name) {
    Reader reader(bytes);
    CadModel model;
    walk(reader, model);
    if (!reader.finished()) {
        base::Location where;
        where.file = file_name;
        return base::fail("cad.stream", "what the CAD reader handed over is not complete", std::move(where));
    }
    return model;
}

}  // namespace cusp::geometry::cad
