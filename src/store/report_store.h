// The folder of task reports: one file each, numbered, the oldest dropped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drover/result.h"
#include "store/durable_file.h"
#include "store/files.h"

namespace drover::store {

/// JSON texts that the store does not understand, each without a line break.
struct ReportTexts {
  std::string summary;  ///< what a list shows
  std::string line;     ///< what was driven
};

struct StoredReport {
  std::uint64_t number = 0;  ///< from 1, never given twice while its report is there
  ReportTexts texts;
};

/// As many are kept; the next one drops the oldest.
inline constexpr std::size_t kMaxReports = 50;
inline constexpr std::size_t kMaxReportBytes = std::size_t{4} << 20;

/// Belongs to the storage thread: each call may block as long as the disk does. What it cannot read
/// it leaves out: a report is told, and nothing hangs on it.
class ReportStore final {
 public:
  /// `files` is borrowed for the lifetime of this object; `folder` exists.
  ReportStore(Files& files, std::string folder);

  /// Returns nothing when it is durable; fails without harm to those that are there.
  std::optional<Failure> save(const ReportTexts& texts);
  /// The newest first; without their lines. Only the front of each is read, for a stop that is to
  /// be kept waits meanwhile: a summary that is JSON is believed, its checksum is not compared.
  std::vector<StoredReport> list() const;
  /// 0: the newest.
  Result<StoredReport, Failure> read(std::uint64_t number) const;

 private:
  std::vector<std::uint64_t> numbers() const;
  std::optional<std::string> summary(std::uint64_t number) const;
  void remove_leftovers();
  std::string path(const std::string& file) const { return folder_ + "/" + file; }

  Files& files_;
  std::string folder_;
};

}  // namespace drover::store
