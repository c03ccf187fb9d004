#pragma once
/// \file
/// Views that are left out as crosses on the hemisphere, a colour for each reason.

#include "hemisphere_picture.h"
#include "tsuya/lab/measure_session.h"

namespace tsuya::lab {

/// Those of a plan: what the rig cannot take.
void add_left_out(const Plan &plan, HemispherePicture &picture);

/// Those of a measurement: what the pictures do not give.
void add_left_out(const SessionMeasurement &measured, HemispherePicture &picture);

} // namespace tsuya::lab
