// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Between the planner and the control's writer: do the linear axes keep their travel in this setup?
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/kinematics/linear_travel.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/machine/setup_definition.hpp>
#include <cusp/post/writer/nc_program.hpp>

#include <memory>
#include <string>

namespace cusp::post {

/// Passes every step on as it is, and follows the machine through it: from home to the part, along every move and arc, into
/// every hole. Sees what the program says, inserted blocks included.
///
/// Problems: those of `kinematics::LinearTravel`; `post.setup-offset` (error: the setup does not place the work offset),
/// `post.setup-tool` (error, once per tool call: it does not know the tool's length, so that what follows is not checked).
class TravelCheck : public NcSink {
public:
    /// `cl_file` is for messages. Machine, setup and the next sink must outlive the check.
    TravelCheck(const kinematics::Machine& machine, const machine::SetupDefinition& setup,
                const std::string& work_offset, std::string cl_file, NcSink& next);
    ~TravelCheck() override;

    void step(const NcStep& step) override;
    /// After the last step.
    void finish();

    [[nodiscard]] base::Diagnostics report() const;
    [[nodiscard]] const kinematics::TravelSummary& summary() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cusp::post
