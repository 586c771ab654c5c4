// A small case, and how to find things in its files.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/solver_case.hpp>

#include "cases/case_files.hpp"
#include "support/sample_meshes.hpp"

namespace lamina::test {

inline SolverConditions some_conditions(double alpha_deg = 10) {
    return {.reference = {.chord = 2, .alpha_deg = alpha_deg, .reynolds = 4e6}};
}

/// Returns an annulus with quadrilaterals in its layer.
inline Mesh case_mesh() { return annulus({.quads_in_layer = true}); }

/// Returns the text of a file of a case; fails where there is none.
inline std::string text_of(const std::vector<cases::SolverCaseFile>& files, const std::string& name) {
    const auto file = std::find_if(files.begin(), files.end(), [&](const auto& f) { return f.name == name; });
    EXPECT_NE(file, files.end()) << name;
    return file == files.end() ? "" : file->text;
}

/// Returns what follows a key, up to the semicolon: the words of the line that begins with it.
inline std::string value_of(const std::string& text, const std::string& key) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string first, rest;
        words >> first >> std::ws;
        if (first != key) continue;
        std::getline(words, rest);
        return rest.substr(0, rest.find(';'));
    }
    ADD_FAILURE() << key << " is missing";
    return {};
}

/// Returns the numbers of a text such as "uniform (1 0 0)".
inline std::vector<double> numbers_in(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
    std::istringstream words(text);
    std::vector<double> numbers;
    for (std::string word; words >> word;) {
        try {
            numbers.push_back(std::stod(word));
        } catch (const std::invalid_argument&) {
            continue;
        }
    }
    return numbers;
}

}  // namespace lamina::test
