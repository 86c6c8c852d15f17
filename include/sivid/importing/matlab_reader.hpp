// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_MATLAB_READER_HPP
#define SIVID_IMPORTING_MATLAB_READER_HPP

/// @file
/// Needs libmatio and zlib (Debian: libmatio-dev, zlib1g-dev; CMake: sivid::matlab).

#include <sivid/importing/table/detail/whole_level5.hpp>
#include <sivid/importing/table/recorded_files.hpp>
#include <sivid/io/detail/problem_apart.hpp>
#include <sivid/io/input_error.hpp>
#include <sivid/io/text/text_file.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <matio.h>

namespace sivid {

/// Reads what libmatio reads of a file; users call read_matlab.
class matlab_reader {
    struct closes {
        void operator()(mat_t* file) const { Mat_Close(file); }
    };
    struct frees {
        void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
    };

public:
    explicit matlab_reader(std::filesystem::path const& file, std::string_view text)
        : result_{file.string(), {}} {
        require_whole(text);
        mat_.reset(Mat_Open(result_.name.c_str(), MAT_ACC_RDONLY));
        if (!mat_) fail("it is cut or damaged");
    }

    [[nodiscard]] matlab_file read() {
        while (auto const v = std::unique_ptr<matvar_t, frees>{Mat_VarReadNextInfo(mat_.get())}) {
            std::string const name = v->name == nullptr ? "" : v->name;
            // MATLAB's store of what its objects hold has no name, or one such as #refs#.
            if (!name.empty() && name.front() != '#') add(*v, name, 0);
        }
        if (result_.variables.empty()) fail("it has no variables, or it is cut or damaged");
        return std::move(result_);
    }

    /// Version 7.3.
    [[nodiscard]] static bool is_hdf(std::string_view text) {
        constexpr std::string_view hdf = "\x89HDF\r\n";
        return text.size() > 520 && text.substr(512).starts_with(hdf);
    }
    [[noreturn]] static void fail(std::filesystem::path const& file, std::string const& problem) {
        throw input_error{
            {.file = file.string()}, problem, "save it again, with save -v6, -v7 or -v7.3"};
    }

private:
    static constexpr std::size_t deepest = 8;

    [[noreturn]] void fail(std::string const& problem) const { fail(result_.name, problem); }

    /// Of level 5 or of version 7.3.
    void require_whole(std::string_view text) const {
        if (is_hdf(text)) return;
        auto const order = text.size() < whole_level5::head ? "" : text.substr(126, 2);
        if (order != "IM" && order != "MI") fail("no MATLAB file of level 5 or of version 7.3");
        if (text[order == "IM" ? 125 : 124] != 1)
            fail("a MATLAB file of another version than level 5 or 7.3");
        if (!whole_level5{text, static_cast<std::size_t>(largest_text)})
            fail("it is cut or damaged, or inflates to more than 1 GB");
    }

    void add(matvar_t& v, std::string const& name, std::size_t depth) {
        auto const kind = v.class_type;
        if (kind == MAT_C_EMPTY && Mat_GetVersion(mat_.get()) == MAT_FT_MAT5) return; // a field
        bool const flat = v.rank == 2 && v.dims != nullptr;
        if (kind == MAT_C_STRUCT && flat && v.dims[0] == 1 && v.dims[1] == 1 && depth < deepest)
            return add_fields(v, name + ".", depth + 1);
        matlab_variable result;
        result.name = name;
        result.object = kind == MAT_C_OPAQUE || kind == MAT_C_OBJECT || kind == MAT_C_EMPTY;
        result.about = about(v);
        if (flat) {
            result.rows = v.dims[0];
            result.columns = v.dims[1];
            if (v.isComplex == 0) take_numbers(v, result);
        }
        result_.variables.push_back(std::move(result));
    }

    /// The fields of a structure of one element.
    void add_fields(matvar_t& v, std::string const& prefix, std::size_t depth) {
        auto* const* const names = Mat_VarGetStructFieldnames(&v);
        for (unsigned i = 0; names != nullptr && i < Mat_VarGetNumberOfFields(&v); ++i)
            if (auto* const field = Mat_VarGetStructFieldByIndex(&v, i, 0))
                add(*field, prefix + names[i], depth);
    }

    [[nodiscard]] static std::string about(matvar_t const& v) {
        static constexpr char const* classes[] = {
            "",     "cell",  "struct", "object", "char",  "sparse", "double", "single",
            "int8", "uint8", "int16",  "uint16", "int32", "uint32", "int64",  "uint64"};
        if (v.class_type == MAT_C_OPAQUE || v.class_type == MAT_C_EMPTY)
            return "an object, such as a table, a datetime or a string";
        std::string text = v.isComplex != 0 ? "complex " : "";
        text += v.class_type < std::size(classes) ? classes[v.class_type] : "something else";
        for (int i = 0; i < v.rank && v.dims != nullptr; ++i)
            text += (i == 0 ? " " : "x") + std::to_string(v.dims[i]);
        return text;
    }

    void take_numbers(matvar_t& v, matlab_variable& result) {
        switch (v.class_type) {
        case MAT_C_DOUBLE:
            return take<double, double>(v, result);
        case MAT_C_SINGLE:
            return take<float, float>(v, result);
        case MAT_C_INT8:
            return take<std::int8_t, std::int64_t>(v, result);
        case MAT_C_UINT8:
            return take<std::uint8_t, std::uint64_t>(v, result);
        case MAT_C_INT16:
            return take<std::int16_t, std::int64_t>(v, result);
        case MAT_C_UINT16:
            return take<std::uint16_t, std::uint64_t>(v, result);
        case MAT_C_INT32:
            return take<std::int32_t, std::int64_t>(v, result);
        case MAT_C_UINT32:
            return take<std::uint32_t, std::uint64_t>(v, result);
        case MAT_C_INT64:
            return take<std::int64_t, std::int64_t>(v, result);
        case MAT_C_UINT64:
            return take<std::uint64_t, std::uint64_t>(v, result);
        default:
            return;
        }
    }

    /// The numbers of a matrix, once it is known that they are not too many.
    template <class Stored, class Kept>
    void take(matvar_t& v, matlab_variable& result) {
        auto const most = (static_cast<std::size_t>(largest_text) - bytes_) / sizeof(Kept);
        if (result.rows != 0 && result.columns > most / result.rows)
            fail(text_of("it is damaged, or its numbers are more than 1 GB (",
                         in_quotes(result.name), " is ", result.about, ")"));
        auto const count = result.rows * result.columns;
        bytes_ += count * sizeof(Kept);
        if (count == 0) {
            result.numbers = std::vector<Kept>{};
            return;
        }
        bool const read = Mat_VarReadDataAll(mat_.get(), &v) == 0 && v.data != nullptr;
        if (!read || v.nbytes != count * sizeof(Stored))
            fail(text_of(in_quotes(result.name), " is cut or damaged"));
        auto const* const numbers = static_cast<Stored const*>(v.data);
        result.numbers = std::vector<Kept>(numbers, numbers + count);
    }

    matlab_file result_;
    std::unique_ptr<mat_t, closes> mat_;
    std::size_t bytes_ = 0; ///< of all numbers
};

/// The variables of a file that MATLAB has saved (-v6, -v7 or -v7.3), as import_tools wants
/// them: real full matrices of numbers, also as fields of structures; others are listed and cannot
/// be read.
/// @throws input_error  for other formats and for damaged files
/// @cost  linear in the size, inflated
[[nodiscard]] inline matlab_file read_matlab(std::filesystem::path const& file) {
    auto const text = read_text(file);
    auto const read = [&] { return matlab_reader{file, text}.read(); };
    // Some damaged files end the HDF5 library by a signal, or keep it busy for ever.
    if (matlab_reader::is_hdf(text)) {
        if (auto const problem = problem_apart([&] { (void)read(); }))
            matlab_reader::fail(file, *problem);
    }
    return read();
}

} // namespace sivid

#endif // SIVID_IMPORTING_MATLAB_READER_HPP
