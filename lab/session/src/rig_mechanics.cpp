#include "tsuya/lab/rig_mechanics.h"

#include "tsuya/lab/number_text.h"

namespace tsuya::lab {

RigMechanics::RigMechanics(const RigFile &rig, Clock &clock, AskOperator ask, CommandRun how)
    : rig_(rig), clock_(clock), ask_(std::move(ask)), how_(std::move(how)) {}

void RigMechanics::run(const std::vector<std::string> &words, Seconds timeout) {
    CommandRun how = how_;
    how.timeout = timeout;
    run_command(words, clock_, how);
}

void RigMechanics::move(AxisName name, double position_deg) {
    const RigAxis &axis = rig_.axis(name);
    const std::string degrees = number_text(position_deg);
    switch (axis.drive) {
    case AxisDrive::by_operator:
        ask_(std::string("turn ") + name_of(name) + " to " + degrees + " degrees");
        break;
    case AxisDrive::command:
        run(filled_in(axis.command, {{"axis", name_of(name)}, {"deg", degrees}}), axis.timeout);
        break;
    case AxisDrive::grbl: {
        std::unique_ptr<GrblController> &controller = controllers_[axis.port];
        if (!controller)
            controller = std::make_unique<GrblController>(axis.port, clock_, how_.stop);
        controller->move(axis, position_deg);
        break;
    }
    }
}

void RigMechanics::place(FrameKind sample) {
    if (rig_.sample.drive == AxisDrive::command)
        run(filled_in(rig_.sample.command, {{"sample", name_of(sample)}}), rig_.sample.timeout);
    else
        ask_(std::string("put ") +
             (sample == FrameKind::cloth   ? "the cloth"
              : sample == FrameKind::white ? "the white standard"
                                           : "the black trap") +
             " under the camera");
}

} // namespace tsuya::lab
