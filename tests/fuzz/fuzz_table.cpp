// TABLE.csv from any bytes: tables of values above or at 0, or an Error.

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/reflectance_file.h"
#include "tsuya/sdk/text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    using namespace tsuya;
    try {
        const std::string_view bytes(reinterpret_cast<const char *>(data), size);
        const ReflectanceFile file = parse_reflectance_file(decode_text(bytes, "fuzz"), "fuzz");
        const std::size_t rows = file.channels.at(0).table.rows.size();
        for (const TableChannel &channel : file.channels) {
            if (rows == 0 || channel.table.rows.size() != rows)
                std::abort();
            for (const ReflectanceRow &row : channel.table.rows)
                if (!(row.brdf_per_sr >= 0 && row.sigma_per_sr >= 0 && row.theta_i >= 0 &&
                      row.theta_r >= 0 && row.to_viewer().z > -1e-9 && std::isfinite(row.phi_i)))
                    std::abort();
        }
    } catch (const Error &error) {
        for (const Problem &problem : error.problems())
            if (problem.what.empty() || problem.where.empty())
                std::abort();
    }
    return 0;
}
