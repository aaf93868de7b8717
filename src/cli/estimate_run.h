// The robot's estimator fed from a log: what comes out is what the robot would have believed.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <ostream>
#include <string>

#include "drover/path.h"
#include "engine/config.h"

namespace drover::cli {

struct EstimateRun {
  engine::EngineConfig config;
  double rate_Hz = 10;                  ///< of the rows that are written
  std::optional<GeodeticPoint> origin;  ///< none: the first position
};

struct EstimateOutcome {
  std::string problem;  ///< of the log, with line and column; empty: all of it was read
  std::uint64_t rows = 0;
  std::uint64_t poses = 0;
};

/// Steps as often as the robot does, each measurement given in the step after it was received. What
/// was written before a problem stays.
EstimateOutcome estimate(std::istream& log, const EstimateRun& run, std::ostream& out);

}  // namespace drover::cli
