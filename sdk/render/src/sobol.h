#pragma once
// Ten dimensions of the Sobol sequence: eight that every path takes, which fill a register, and two
// further ones.

#include <array>
#include <cstdint>

namespace tsuya {

inline constexpr std::size_t kSobolDimensions = 8, kFurtherSobolDimensions = 2;

// One value a dimension, a fraction of 2^32 with its bits in reversed order: what [Burley]
// scrambles.
using SobolPoint = std::array<std::uint32_t, kSobolDimensions>;
using FurtherSobolPoint = std::array<std::uint32_t, kFurtherSobolDimensions>;

namespace sobol {

// [Joe] new-joe-kuo-6: a primitive polynomial and the first direction numbers. The first dimension
// reverses the bits of the index, and has none.
struct Dimension {
    unsigned degree, coefficients;
    std::array<std::uint32_t, 5> first;
};
inline constexpr std::array<Dimension, kSobolDimensions + kFurtherSobolDimensions - 1> kDimensions =
    {{
        {1, 0, {1}},
        {2, 1, {1, 3}},
        {3, 1, {1, 3, 1}},
        {3, 2, {1, 1, 1}},
        {4, 1, {1, 1, 3, 3}},
        {4, 4, {1, 3, 5, 13}},
        {5, 2, {1, 1, 5, 5, 17}},
        {5, 4, {1, 1, 5, 5, 5}},
        {5, 7, {1, 1, 7, 11, 19}},
    }};

// Column i of the generator matrix: what bit i of the index adds.
using Columns = std::array<std::uint32_t, 32>;

constexpr Columns columns_of(const Dimension &d) {
    Columns v{};
    for (unsigned i = 0; i < 32; ++i) {
        if (i < d.degree) {
            v[i] = d.first[i] << (31 - i);
            continue;
        }
        v[i] = v[i - d.degree] ^ (v[i - d.degree] >> d.degree);
        for (unsigned k = 1; k < d.degree; ++k)
            if ((d.coefficients >> (d.degree - 1 - k)) & 1u)
                v[i] ^= v[i - k];
    }
    return v;
}

constexpr std::uint32_t reversed(std::uint32_t x) {
    std::uint32_t r = 0;
    for (int i = 0; i < 32; ++i)
        r |= ((x >> i) & 1u) << (31 - i);
    return r;
}

// What each value of each four bits of the index adds to all dimensions.
template <class Point> using Table = std::array<std::array<Point, 16>, 8>;

// \param first of the dimensions
template <class Point> constexpr Table<Point> make_table(std::size_t first) {
    Table<Point> table{};
    for (std::size_t i = 0; i < Point().size(); ++i) {
        const std::size_t d = first + i;
        Columns columns{};
        if (d > 0)
            columns = columns_of(kDimensions[d - 1]);
        for (std::size_t bit = 0; bit < 32; ++bit) {
            const std::uint32_t column = d == 0 ? 1u << bit : reversed(columns[bit]);
            for (std::size_t value = 0; value < 16; ++value)
                if ((value >> (bit % 4)) & 1u)
                    table[bit / 4][value][i] ^= column;
        }
    }
    return table;
}

inline constexpr Table<SobolPoint> kTable = make_table<SobolPoint>(0);
inline constexpr Table<FurtherSobolPoint> kFurtherTable =
    make_table<FurtherSobolPoint>(kSobolDimensions);

template <class Point> Point look_up(const Table<Point> &table, std::uint32_t index) {
    Point point{};
    for (std::size_t i = 0; i < 8; ++i) {
        const Point &add = table[i][(index >> (4 * i)) & 15u];
        for (std::size_t d = 0; d < point.size(); ++d)
            point[d] ^= add[d];
    }
    return point;
}

} // namespace sobol

inline SobolPoint sobol_reversed(std::uint32_t index) {
    return sobol::look_up(sobol::kTable, index);
}

inline FurtherSobolPoint further_sobol_reversed(std::uint32_t index) {
    return sobol::look_up(sobol::kFurtherTable, index);
}

} // namespace tsuya
