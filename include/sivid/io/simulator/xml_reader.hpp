// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_SIMULATOR_XML_READER_HPP
#define SIVID_IO_SIMULATOR_XML_READER_HPP

/// @file
/// Needs expat (Debian: libexpat1-dev; CMake: sivid::xml).

#include <sivid/io/simulator/robot_file.hpp>
#include <sivid/io/text/text_file.hpp>

#include <cstddef>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <expat.h>

namespace sivid {

/// Reads an XML file by expat, which tells where tags stand; what is within a tag, which it has
/// found to be well formed, is looked up here. Users call read_xml.
class xml_reading {
public:
    explicit xml_reading(std::filesystem::path const& file)
        : result_{file.string(), read_text(file), {}}, parser_{XML_ParserCreate(nullptr)} {
        if (!parser_) throw std::bad_alloc();
        std::error_code fault;
        auto& text = result_.text;
        if (std::filesystem::file_size(file, fault) == text.size() + 3 && !fault)
            text.insert(0, "\xEF\xBB\xBF"); // which read_text leaves out
        if (text.size() > largest)
            result_.fail(0, "larger than 20 MB", "give a robot's description without its meshes");
        if (text.find('\0') != std::string::npos)
            result_.fail(0, "UTF-16, or no text", "save it as UTF-8");
    }
    [[nodiscard]] xml_document operator()() {
        auto* const p = parser_.get();
        XML_SetUserData(p, this);
        XML_SetElementHandler(p, &begins, &ends);
        XML_SetStartDoctypeDeclHandler(p, &defines);
        auto const& text = result_.text;
        auto const said = XML_Parse(p, text.data(), static_cast<int>(text.size()), 1);
        if (fault_) std::rethrow_exception(fault_);
        if (said != XML_STATUS_OK)
            result_.fail(line(),
                         std::string{"no well-formed XML: "} + XML_ErrorString(XML_GetErrorCode(p)),
                         "correct it, or give the whole file; a comment holds no --");
        return std::move(result_);
    }

private:
    static constexpr std::size_t largest = 20'000'000; ///< [byte]
    struct frees {
        void operator()(XML_ParserStruct* p) const { XML_ParserFree(p); }
    };

    [[nodiscard]] std::size_t line() const { return XML_GetCurrentLineNumber(parser_.get()); }

    /// No exception passes through expat, which is C.
    template <class Work>
    static void guarded(void* self, Work const& work) {
        auto& own = *static_cast<xml_reading*>(self);
        if (own.fault_) return;
        try {
            work(own);
        } catch (...) {
            own.fault_ = std::current_exception();
            XML_StopParser(own.parser_.get(), XML_FALSE);
        }
    }
    static void XMLCALL begins(void* self, char const* name, char const** attributes) {
        guarded(self, [&](xml_reading& own) { own.add(name, attributes); });
    }
    static void XMLCALL ends(void* self, char const* /*name*/) {
        guarded(self, [](xml_reading& own) { own.open_.pop_back(); });
    }
    static void XMLCALL defines(void* self, char const* /*name*/, char const* /*system*/,
                                char const* /*open*/, int /*internal*/) {
        guarded(self, [](xml_reading& own) {
            own.result_.fail(own.line(), "<!DOCTYPE> defines entities, which are not followed",
                             "write their texts in their places, and leave it out");
        });
    }
    void add(char const* name, char const** attributes) {
        auto const& text = result_.text;
        auto const begin = static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_.get()));
        auto const size = static_cast<std::size_t>(XML_GetCurrentByteCount(parser_.get()));
        xml_element e{name, open_.empty() ? 0 : open_.back(), begin, begin + size, line(), {}};
        for (auto at = begin; *attributes != nullptr; attributes += 2) {
            auto const quote = text.find_first_of("\"'", at);
            auto const close = text.find(text[quote], quote + 1);
            e.attributes.push_back({attributes[0], attributes[1], quote + 1, close});
            at = close + 1;
        }
        open_.push_back(result_.elements.size());
        result_.elements.push_back(std::move(e));
    }

    xml_document result_;
    std::vector<std::size_t> open_;
    std::unique_ptr<XML_ParserStruct, frees> parser_;
    std::exception_ptr fault_;
};

/// Reads an XML file with the places of all its elements and attributes.
/// @throws input_error  for what is not well formed, is UTF-16, larger than 20 MB, or has a
/// DOCTYPE
/// @cost  memory a few times that of the text
[[nodiscard]] inline xml_document read_xml(std::filesystem::path const& file) {
    return xml_reading(file)();
}

} // namespace sivid

#endif
