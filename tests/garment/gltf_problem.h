#pragma once
/// \file
/// Wrong glTF files made from right ones, and what is said of them.

#include <string>

#include <gtest/gtest.h>

#include "garment/gltf_samples.h"
#include "tsuya/garment/gltf.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment::test {

/// The first problem: `where: what`.
inline std::string problem(const std::string &bytes) {
    try {
        parse_gltf(bytes, "m.glb");
    } catch (const Error &error) {
        return error.problems().at(0).where + ": " + error.problems().at(0).what;
    }
    return "no error";
}

inline std::string replaced(std::string text, const std::string &from, const std::string &to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The JSON of the square with members before its `scene`.
inline std::string square_with(const std::string &members, const std::string &node = "",
                               const std::string &material = "") {
    return replaced(square_json(node, material), R"("scene":0)", members + R"("scene":0)");
}

} // namespace tsuya::garment::test
