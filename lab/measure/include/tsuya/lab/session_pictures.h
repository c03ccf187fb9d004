#pragma once
/// \file
/// Pictures of a capture session: what is planned, what the camera saw, what was measured.
///
///     write_file("plan.svg", plan_picture(read_plan("satin.plan.jsonl")));

#include "tsuya/lab/measure_session.h"
#include "tsuya/sdk/image.h"

namespace tsuya::lab {

/// The views of a plan on the hemisphere, as SVG: a disk for each direction of light, the distance
/// from its middle theta_r, the angle phi_r from the weft. A line joins the views in their order,
/// from dark to bright; what is left out is crossed, by reason.
std::string plan_picture(const Plan &plan);

/// The values of a table on the same disks, by colour on a logarithmic scale. Views that are left
/// out, of the plan or of the pictures, are crossed, by reason.
/// \param channel which of the channels, below their number
std::string table_picture(const Session &session, const SessionMeasurement &measured,
                          std::size_t channel = 0);

/// Frames of a session with the measured patch outlined: the middle of each, five patches wide,
/// from black to saturation as sRGB; clipped pixels are red. Some views that are left out, a dark
/// frame, white and trap, and views of the cloth from first to last, each under its longest
/// exposure that is not clipped. R, G, B from 0 to 1. Throws Error where no frame can be read, and
/// as draw_sheet.
Image contact_sheet(const Session &session, const SessionMeasurement &measured);

} // namespace tsuya::lab
