// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Expat feeds a stack of names; only what a record needs is kept.
#include "qif/qif_xml.hpp"

#include "compressed.hpp"

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <array>
#include <expat.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

namespace cusp::inspect::qif {

namespace {

constexpr std::size_t block_bytes = 64 * 1024;
constexpr std::size_t deepest = 200;
constexpr std::size_t longest_text = 64 * 1024;
constexpr std::size_t most_texts = 100'000;

constexpr std::array lists{
    "CharacteristicDefinitions",  "CharacteristicNominals", "CharacteristicItems", "CharacteristicActuals",
    "CharacteristicMeasurements", "FeatureItems",           "FeatureActuals",      "MeasuredFeatures",
    "MeasuredPointSets",          "ActualComponentSet"};

bool isList(std::string_view name) { return std::find(lists.begin(), lists.end(), name) != lists.end(); }

/// "q:Points" is Points.
std::string_view localName(std::string_view name) {
    const auto colon = name.rfind(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

bool isBlank(char character) { return character == ' ' || character == '\n' || character == '\t' || character == '\r'; }

class Reader {
public:
    Reader(std::string name, RecordTaker& taker, base::Diagnostics& report)
        : name_(std::move(name)), taker_(taker), report_(report), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(parser_.get(), &Reader::onBegin, &Reader::onEnd);
        XML_SetCharacterDataHandler(parser_.get(), &Reader::onText);
        XML_SetStartDoctypeDeclHandler(parser_.get(), &Reader::onDoctype);
    }

    void read(std::istream& in) {
        while (!stopped_) {
            void* buffer = XML_GetBuffer(parser_.get(), static_cast<int>(block_bytes));
            if (buffer == nullptr) return problem("qif.large", "there is no memory for this document");
            in.read(static_cast<char*>(buffer), static_cast<std::streamsize>(block_bytes));
            if (in.bad()) return problem("io.read", "the document could not be read to its end");
            const auto got = in.gcount();
            const std::string_view packed =
                first_block_ ? compressionOf({static_cast<const char*>(buffer), static_cast<std::size_t>(got)}) : "";
            first_block_ = false;
            if (!packed.empty())
                return problem("qif.compressed", fmt::format("the file is compressed ({}); unpack it first", packed));
            const bool last = got < static_cast<std::streamsize>(block_bytes);
            if (XML_ParseBuffer(parser_.get(), static_cast<int>(got), last ? 1 : 0) == XML_STATUS_ERROR) {
                if (!stopped_)
                    problem("qif.xml",
                            fmt::format("not well-formed XML: {}", XML_ErrorString(XML_GetErrorCode(parser_.get()))));
                return;
            }
            if (last) return;
        }
    }

private:
    static void XMLCALL onBegin(void* self, const XML_Char* name, const XML_Char** attributes) {
        static_cast<Reader*>(self)->begin(localName(name), attributes);
    }
    static void XMLCALL onEnd(void* self, const XML_Char*) { static_cast<Reader*>(self)->end(); }
    static void XMLCALL onText(void* self, const XML_Char* text, int size) {
        static_cast<Reader*>(self)->text({text, static_cast<std::size_t>(size)});
    }
    static void XMLCALL onDoctype(void* self, const XML_Char*, const XML_Char*, const XML_Char*, int) {
        static_cast<Reader*>(self)->problem("qif.doctype", "a document type has no place in QIF and is not read");
    }

    std::size_t line() const { return XML_GetCurrentLineNumber(parser_.get()); }

    void problem(std::string_view code, std::string message) {
        if (stopped_) return;
        const std::size_t column = XML_GetCurrentColumnNumber(parser_.get()) + 1;
        report_.error(code, std::move(message), {name_, line(), column, {}});
        stop();
    }
    void stop() {
        stopped_ = true;
        XML_StopParser(parser_.get(), XML_FALSE);
    }

    void begin(std::string_view name, const XML_Char** attributes) {
        if (stopped_) return;
        if (path_.size() == deepest) return problem("qif.large", "elements lie deeper than any QIF has them");
        const bool starts_record = record_depth_ == 0 && !path_.empty() && isList(path_.back()) && !isList(name);
        path_.emplace_back(name);
        text_.clear();
        is_leaf_ = true;
        if (path_.size() == 1)
            taker_.root(path_[0], attribute(attributes, "versionQIF"), line());
        else if (starts_record)
            openRecord(attributes);
        else if (record_depth_ == 0)
            taker_.begin(path_.back());
        numbers_ = nullptr;
        if (record_depth_ > 0 && path_.size() == record_depth_ + 1) {
            if (path_.back() == "Points") numbers_ = &record_.points;
            if (path_.back() == "Normals") numbers_ = &record_.normals;
        }
        if (taker_.failed()) stop();
    }

    static std::string attribute(const XML_Char** attributes, std::string_view wanted) {
        for (; attributes[0] != nullptr; attributes += 2)
            if (wanted == attributes[0]) return attributes[1];
        return {};
    }

    void openRecord(const XML_Char** attributes) {
        record_ = {};
        record_.list = path_[path_.size() - 2];
        record_.kind = path_.back();
        record_.id = attribute(attributes, "id");
        record_.count = attribute(attributes, "count");
        record_.line = line();
        record_depth_ = path_.size();
    }

    void text(std::string_view piece) {
        if (stopped_) return;
        if (numbers_ != nullptr) return takeNumbers(piece);
        if (text_.size() + piece.size() > longest_text)
            return problem("qif.large", "a text is longer than any QIF has it");
        text_ += piece;
    }

    /// A number may be cut by the end of a piece: it waits for the next one.
    void takeNumbers(std::string_view piece) {
        for (const char character : piece) {
            if (!isBlank(character))
                text_ += character;
            else if (!text_.empty())
                takeNumber();
            if (text_.size() > longest_number) return problem("qif.number", "this is not a list of numbers");
            if (stopped_) return;
        }
    }
    void takeNumber() {
        const auto number = base::parseDouble(text_);
        if (!number) return problem("qif.number", fmt::format("'{}' is not a number", text_));
        numbers_->push_back(*number);
        text_.clear();
    }

    void end() {
        if (stopped_) return;
        if (numbers_ != nullptr) {
            if (!text_.empty()) takeNumber();
            numbers_ = nullptr;
        } else if (is_leaf_) {
            endLeaf();
        }
        text_.clear();
        is_leaf_ = false;
        if (record_depth_ == path_.size()) {
            taker_.take(record_);
            record_depth_ = 0;
        }
        path_.pop_back();
        if (taker_.failed()) stop();
    }

    void endLeaf() {
        const auto is_text = [](char character) { return !isBlank(character); };
        const auto first = std::find_if(text_.begin(), text_.end(), is_text);
        const auto last = std::find_if(text_.rbegin(), text_.rend(), is_text).base();
        const std::string value = first < last ? std::string(first, last) : std::string();
        if (record_depth_ == 0) {
            taker_.leaf(fmt::format("{}", fmt::join(path_.begin() + 1, path_.end(), "/")), value, line());
        } else if (path_.size() > record_depth_) {
            if (record_.texts.size() == most_texts)
                return problem("qif.large", "an element holds more texts than any QIF has");
            const auto begin = path_.begin() + static_cast<std::ptrdiff_t>(record_depth_);
            record_.texts.emplace_back(fmt::format("{}", fmt::join(begin, path_.end(), "/")), value);
        }
    }

    static constexpr std::size_t longest_number = 100;

    std::string name_;
    RecordTaker& taker_;
    base::Diagnostics& report_;
    std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
    std::vector<std::string> path_;
    std::string text_;
    bool is_leaf_ = false;
    Record record_;
    std::size_t record_depth_ = 0;  ///< how deep the record's element lies; 0 outside of records
    std::vector<double>* numbers_ = nullptr;
    bool stopped_ = false;
    bool first_block_ = true;
};

}  // namespace

std::string_view Record::text(std::string_view path) const {
    for (const auto& [where, text] : texts)
        if (where == path) return text;
    return {};
}

void readRecords(std::istream& in, const std::string& name, RecordTaker& taker, base::Diagnostics& report) {
    Reader(name, taker, report).read(in);
}

}  // namespace cusp::inspect::qif
