// One line of a CAN log as `candump -l` writes it: "(1718000000.123456) can0 061#0000000008000100".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "drover/can_frame.h"
#include "drover/time.h"

namespace drover::cli {

struct LoggedFrame {
  Time time = kNever;  ///< the log's stamp
  std::string bus;
  CanFrame frame;
};

/// Nothing when the line is not of that form.
std::optional<LoggedFrame> parse_candump(std::string_view line);

}  // namespace drover::cli
