// A log of measurements as a table (CSV), for `drover estimate --in` and
// `drover calibrate --in`. Pure: line by line, no file.
//
// The columns, whose names have their units, are in README.md. An empty cell is a value that is not
// of this row's instant: sensors have rates of their own.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drover/measurement.h"
#include "drover/result.h"

namespace drover::cli {

struct LogError {
  std::size_t line = 0;    ///< from 1
  std::size_t column = 0;  ///< from 1, of the table; 0: of the whole line
  std::string name;        ///< of that column
  std::string message;
  /// "line 3, column 2 (latitude_deg): ..."
  std::string text() const;
};

/// What the base did, whichever way the log tells it.
struct LoggedMotion {
  bool by_rims = false;  ///< of the left and of the right, m/s; else a twist: m/s and rad/s
  double first = 0;
  double second = 0;
};

/// One row's measurements, true at `time`.
struct LogRow {
  Time time = kNever;
  Time received = kNever;  ///< of rows the order; `time` where the log does not tell
  std::optional<LoggedMotion> motion;
  std::optional<ImuSample> imu;
  std::optional<GnssPosition> position;
  std::optional<GnssHeading> heading;
  // Of no use to the estimator; for `drover calibrate`:
  std::optional<double> receiver_mps;   ///< the receiver's own speed over ground
  std::optional<LoggedMotion> command;  ///< what the base was told
};

class LogReader final {
 public:
  /// The first line that is neither empty nor begins with '#'.
  std::optional<LogError> read_head(std::string_view line);
  /// Any other; nothing for one that is empty or a comment.
  Result<std::optional<LogRow>, LogError> read_row(std::string_view line);

  bool has_head() const { return !columns_.empty(); }

 private:
  std::optional<LogError> read_cells(std::string_view line);
  LogError error(std::size_t column, std::string message) const;
  std::optional<double> value(std::string_view name) const;
  std::size_t column_of(std::string_view name) const;
  /// Those of which either all or none must be in a row, or in the head.
  std::optional<LogError> needs(std::string_view name, std::string_view other) const;
  std::optional<LogError> check_groups() const;
  std::optional<LogError> check_values() const;
  void fill(LogRow& row) const;

  std::size_t line_ = 0;
  std::vector<std::string> columns_;
  std::vector<std::optional<double>> cells_;
  Time last_ = kNever;
};

}  // namespace drover::cli
