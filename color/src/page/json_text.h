#pragma once
/// \file
/// JSON for the page: text that is put together, and is safe within a <script> element.

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace tsuya::json {

/// A string with its quotes; `<` as \u003c, so that no element ends in it.
std::string text(std::string_view value);
/// A number of at most so many significant digits. The value must be finite.
std::string number(double value, int digits = 17);
/// `[a,b,...]`
std::string array(std::span<const std::string> items);
/// An array of numbers.
std::string numbers(std::span<const double> values, int digits = 17);
/// An array of three numbers.
std::string vector(const glm::dvec3 &v);
/// Three rows of a matrix.
std::string rows(const glm::dmat3 &m);
/// `{"a":...,...}` of names and JSON values.
std::string object(std::span<const std::pair<std::string, std::string>> members);

} // namespace tsuya::json
