#pragma once
/// \file
/// A simulated line that breaks when a test says so.

#include "tsuya/lab/simulated_line.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {

/// Records like SimulatedLine. `set` calls number `first_failure` (from 1) and the ones after it,
/// `failures` in all, throw without moving the line.
class FailingLine final : public OutputLine {
  public:
    FailingLine(std::string name, Clock &clock, int first_failure, int failures = 1)
        : line_(std::move(name), clock), first_(first_failure), last_(first_failure + failures) {}

    void set(bool active) override {
        ++calls_;
        if (calls_ >= first_ && calls_ < last_)
            throw Error({.what = "the wire is broken", .where = name(), .accepted = "a wire"});
        line_.set(active);
    }
    const std::string &name() const override { return line_.name(); }
    bool active() const { return line_.active(); }
    int calls() const { return calls_; }

  private:
    SimulatedLine line_;
    int first_;
    int last_;
    int calls_ = 0;
};

} // namespace tsuya::lab
