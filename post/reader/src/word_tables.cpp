// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Sources: Siemens Programming Manual Fundamentals 12/2019 (list of G functions) and Job Planning 06/2009.
#include "word_tables.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

namespace cusp::post::reader {

namespace {

constexpr GroupCode group_codes[] = {
    {"CIP", 1},        {"ORIEULER", 50},   {"ORIRPY", 50},     {"OSC", 34},       {"OSS", 34},       {"OSSE", 34},
    {"OSOF", 34},      {"OSD", 34},        {"OST", 34},        {"ORISON", 61},    {"ORISOF", 61},    {"G0", 1},
    {"G1", 1},         {"G2", 1},          {"G3", 1},          {"STOPFIFO", 4},   {"STARTFIFO", 4},  {"FIFOCTRL", 4},
    {"G17", 6},        {"G18", 6},         {"G19", 6},         {"G40", 7},        {"G41", 7},        {"G42", 7},
    {"G53", 9, false}, {"G153", 9, false}, {"SUPA", 9, false}, {"G60", 10},       {"G64", 10},       {"G641", 10},
    {"G642", 10},      {"G643", 10},       {"G644", 10},       {"G645", 10},      {"G9", 11, false}, {"G601", 12},
    {"G602", 12},      {"G603", 12},       {"G70", 13},        {"G71", 13},       {"G700", 13},      {"G710", 13},
    {"G90", 14},       {"G91", 14},        {"G93", 15},        {"G94", 15},       {"G95", 15},       {"CFC", 16},
    {"CFTCP", 16},     {"CFIN", 16},       {"NORM", 17},       {"KONT", 17},      {"G450", 18},      {"G451", 18},
    {"BRISK", 21},     {"SOFT", 21},       {"DRIVE", 21},      {"CUT2D", 22},     {"CUT2DF", 22},    {"CUT3DC", 22},
    {"CUT3DF", 22},    {"FFWOF", 24},      {"FFWON", 24},      {"ORIWKS", 25},    {"ORIMKS", 25},    {"ORIC", 27},
    {"ORID", 27},      {"WALIMON", 28},    {"WALIMOF", 28},    {"COMPOF", 30},    {"COMPON", 30},    {"COMPCURV", 30},
    {"COMPCAD", 30},   {"COMPSURF", 30},   {"FNORM", 37},      {"SPATH", 45},     {"UPATH", 45},     {"CP", 49},
    {"ORIVECT", 51},   {"ORIPLANE", 51},   {"ORIAXES", 51},    {"RTLION", 55},    {"RTLIOF", 55},    {"DYNNORM", 59},
    {"DYNPOS", 59},    {"DYNROUGH", 59},   {"DYNSEMIFIN", 59}, {"DYNFINISH", 59}, {"DYNPREC", 59},
};

struct Refused {
    std::string_view name;
    std::string_view what;
};

constexpr std::string_view a_frame = "a programmable frame";
constexpr std::string_view a_subprogram = "a subprogram call";
constexpr std::string_view a_cycle = "a machining cycle";
constexpr std::string_view a_spline = "spline or polynomial interpolation";
constexpr std::string_view a_transformation = "a transformation other than TRAORI";
constexpr std::string_view a_synchronized_action = "a synchronized action";

constexpr std::string_view flow_statements[] = {"GOTO",    "GOTOF",  "GOTOB", "GOTOC",    "GOTOS", "CASE",   "IF",
                                                "ELSE",    "ENDIF",  "WHILE", "ENDWHILE", "FOR",   "ENDFOR", "LOOP",
                                                "ENDLOOP", "REPEAT", "UNTIL", "PROC",     "RET"};
/// Words with a meaning of their own in `block_content.cpp`.
constexpr std::string_view other_words[] = {"TRAORI", "TRAFOOF", "TRAOOF", "STOPRE", "MSG",  "SETMS",
                                            "TRANS",  "ATRANS",  "ROT",    "AROT",   "MCALL"};

constexpr Refused statements[] = {
    {"REPEATB", "a repetition of blocks"},
    {"EXTERN", a_subprogram},
    {"CALL", a_subprogram},
    {"PCALL", a_subprogram},
    {"EXTCALL", a_subprogram},
    {"ISOCALL", a_subprogram},
    {"WHEN", a_synchronized_action},
    {"WHENEVER", a_synchronized_action},
    {"EVERY", a_synchronized_action},
    {"FROM", a_synchronized_action},
    {"DO", a_synchronized_action},
    {"REDEF", "a redefinition"},
    {"DEFINE", "a macro"},
    {"SET", "a macro"},
    {"ROTS", a_frame},
    {"AROTS", a_frame},
    {"CROTS", a_frame},
    {"SCALE", a_frame},
    {"ASCALE", a_frame},
    {"MIRROR", a_frame},
    {"AMIRROR", a_frame},
};

constexpr Refused refused_words[] = {
    {"TOFRAME", a_frame},
    {"TOFRAMEX", a_frame},
    {"TOFRAMEY", a_frame},
    {"TOFRAMEZ", a_frame},
    {"TOROT", a_frame},
    {"TOROTOF", a_frame},
    {"TCARR", "an orientable tool carrier"},
    {"TCOABS", "an orientable tool carrier"},
    {"TCOFR", "an orientable tool carrier"},
    {"TRANSMIT", a_transformation},
    {"TRACYL", a_transformation},
    {"TRAANG", a_transformation},
    {"TRACON", a_transformation},
    {"ASPLINE", a_spline},
    {"BSPLINE", a_spline},
    {"CSPLINE", a_spline},
    {"POLY", a_spline},
    {"ORICURVE", a_spline},
    {"ORIPATH", "orientation relative to the path"},
    {"ORIPATHS", "orientation relative to the path"},
    {"ORICONCW", "orientation on a cone"},
    {"ORICONCCW", "orientation on a cone"},
    {"ORICONIO", "orientation on a cone"},
    {"ORICONTO", "orientation on a cone"},
    {"PTP", "point-to-point travel"},
    {"PTPG0", "point-to-point travel"},
    {"ORIVIRT1", "orientation by virtual axes"},
    {"ORIVIRT2", "orientation by virtual axes"},
    {"ORIAXPOS", "orientation by virtual axes"},
    {"ORIRPY2", "orientation by angles in another order"},
    {"CT", "a tangential circle"},
    {"INVCW", "an involute"},
    {"INVCCW", "an involute"},
    {"FLIN", "a feed profile"},
    {"FCUB", "a feed profile"},
    {"FGROUP", "a path group other than the default"},
    {"DIAMON", "diameter programming"},
    {"DIAM90", "diameter programming"},
    {"M70", "axis operation of the spindle"},
    {"SPCON", "position control of the spindle"},
    {"MEAS", "measuring"},
    {"MEAW", "measuring"},
};

constexpr Refused refused_addresses[] = {
    {"AP", "polar coordinates"},
    {"RP", "polar coordinates"},
    {"A4", "orientation by surface normals"},
    {"B4", "orientation by surface normals"},
    {"C4", "orientation by surface normals"},
    {"A5", "orientation by surface normals"},
    {"B5", "orientation by surface normals"},
    {"C5", "orientation by surface normals"},
    {"A6", "orientation on a cone"},
    {"B6", "orientation on a cone"},
    {"C6", "orientation on a cone"},
    {"A7", "orientation on a cone"},
    {"B7", "orientation on a cone"},
    {"C7", "orientation on a cone"},
    {"LEAD", "orientation relative to the path"},
    {"TILT", "orientation relative to the path"},
    {"THETA", "a rotation of the tool about itself"},
    {"SPOS", "spindle positioning"},
    {"SPOSA", "spindle positioning"},
    {"RND", "a rounded corner"},
    {"RNDM", "a rounded corner"},
    {"CHF", "a chamfer"},
    {"CHR", "a chamfer"},
    {"OFFN", "a contour offset"},
    {"MCALL", "a modal subprogram call"},
    {"PO", a_spline},
    {"PW", a_spline},
    {"SD", a_spline},
    {"POS", "a positioning axis"},
    {"POSA", "a positioning axis"},
    {"FA", "a positioning axis"},
    {"L", a_subprogram},
    {"P", a_subprogram},
};

constexpr std::string_view multi_letter_addresses[] = {"CR",   "AR",  "AP",  "RP",   "TURN",  "CTOL", "OTOL",   "RND",
                                                       "RNDM", "CHF", "CHR", "SPOS", "SPOSA", "ADIS", "ADISPOS"};

template <std::size_t N>
std::string_view lookUp(const Refused (&table)[N], std::string_view name) {
    const auto* const found =
        std::find_if(std::begin(table), std::end(table), [&](const Refused& r) { return r.name == name; });
    return found == std::end(table) ? std::string_view() : found->what;
}

template <std::size_t N>
bool contains(const std::string_view (&table)[N], std::string_view name) {
    return std::find(std::begin(table), std::end(table), name) != std::end(table);
}

/// Settable frames: G500, G54–G57, G505–G599. Their names live for the whole run, so that state can point to them.
const std::array<std::string, 600>& frameNames() {
    static const std::array<std::string, 600> names = [] {
        std::array<std::string, 600> out;
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = "G" + std::to_string(i);
        return out;
    }();
    return names;
}

bool isSettableFrame(int number) {
    return (number >= 54 && number <= 57) || (number >= 505 && number <= 599) || number == 500;
}

/// Group codes by G number, so that a block of a long program costs an array access.
const std::array<std::optional<GroupCode>, 1000>& byNumber() {
    static const std::array<std::optional<GroupCode>, 1000> table = [] {
        std::array<std::optional<GroupCode>, 1000> out;
        for (const GroupCode& code : group_codes) {
            std::size_t number = 0;
            const char* const end = code.name.data() + code.name.size();
            if (code.name[0] == 'G' && std::from_chars(code.name.data() + 1, end, number).ptr == end)
                out[number] = code;
        }
        for (int number = 0; number < 600; ++number)
            if (isSettableFrame(number))
                out[static_cast<std::size_t>(number)] =
                    GroupCode{frameNames()[static_cast<std::size_t>(number)], group::work_offset, true};
        return out;
    }();
    return table;
}

}  // namespace

std::optional<GroupCode> findGroupCode(std::string_view name) {
    const auto* const found = std::find_if(std::begin(group_codes), std::end(group_codes),
                                           [&](const GroupCode& code) { return code.name == name; });
    if (found == std::end(group_codes)) return std::nullopt;
    return *found;
}

std::optional<GroupCode> findGroupCode(int g_number) {
    if (g_number < 0 || g_number >= 1000) return std::nullopt;
    return byNumber()[static_cast<std::size_t>(g_number)];
}

std::string_view refusedWord(std::string_view name) {
    if (const auto what = lookUp(statements, name); !what.empty()) return what;
    if (const auto what = lookUp(refused_words, name); !what.empty()) return what;
    for (const std::string_view prefix : {"CYCLE", "POCKET", "HOLES", "SLOT", "LONGHOLE"})
        if (name.starts_with(prefix)) return a_cycle;
    return {};
}

std::string_view refusedCode(int g_number) {
    switch (g_number) {
        case 5:
        case 7: return "travel on an inclined axis";
        case 33:
        case 34:
        case 35:
        case 331:
        case 332:
        case 63: return "thread cutting or tapping";
        case 25:
        case 26: return "a working area or speed limit";
        case 58:
        case 59: return a_frame;
        case 74:
        case 75: return "a fixed point or reference point approach";
        case 96:
        case 961:
        case 962:
        case 97:
        case 971:
        case 973:
        case 931:
        case 941:
        case 951: return "a feed type other than G93, G94, G95";
        case 110:
        case 111:
        case 112: return "polar coordinates";
        case 140:
        case 141:
        case 142:
        case 143:
        case 147:
        case 148:
        case 247:
        case 248:
        case 347:
        case 348: return "smooth approach and retract";
        default: return {};
    }
}

std::string_view refusedAddress(std::string_view name) { return lookUp(refused_addresses, name); }

bool hasNoEffect(std::string_view call) {
    return call == "WORKPIECE" || call == "GROUP_BEGIN" || call == "GROUP_END" || call == "GROUP_ADDEND";
}

bool isFlowStatement(std::string_view name) { return contains(flow_statements, name); }

bool isStatement(std::string_view name) {
    return name == "DEF" || isFlowStatement(name) || !lookUp(statements, name).empty();
}

bool isVocabulary(std::string_view name) {
    return findGroupCode(name) || hasNoEffect(name) || !refusedWord(name).empty() || contains(other_words, name);
}

bool isAddressWithoutEquals(std::string_view name) {
    const std::size_t digits = name.find_first_of("0123456789");
    if (digits == std::string_view::npos || name.find_first_not_of("0123456789", digits) != std::string_view::npos)
        return false;
    const std::string_view letters = name.substr(0, digits);
    return std::find(std::begin(multi_letter_addresses), std::end(multi_letter_addresses), letters) !=
           std::end(multi_letter_addresses);
}

}  // namespace cusp::post::reader
