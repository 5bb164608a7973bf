#pragma once

#include "arguments.hpp"

/// One function for each verb of the command line. They print on stdout what was asked for and on
/// stderr what goes on, and return the exit code; a human's mistake or a broken source throws.
namespace kestrel::app {

/// Exit code after Ctrl-C or SIGTERM: what was written by then is complete.
constexpr int kInterrupted = 130;

int run(const TrackArguments& arguments);
int run(const ServoArguments& arguments);
int run(const SimulateArguments& arguments);
int run(const ReceiveArguments& arguments);
int run(const CheckArguments& arguments);
int run(const CalibrateArguments& arguments);
int run(const HandEyeArguments& arguments);
int run(const DemoArguments& arguments);
int run(const EvaluateArguments& arguments);
int run(const CompareArguments& arguments);
int run(const MergeArguments& arguments);
int run(const LawsArguments& arguments);
int run(const ExplainArguments& arguments);
int run(const SwitchArguments& arguments);
int run(const KeyArguments& arguments);
int run(const JogArguments& arguments);
int run(const CamerasArguments& arguments);
int run(const RecordArguments& arguments);
int run(const ReplayArguments& arguments);

}  // namespace kestrel::app
