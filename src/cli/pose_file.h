// Where a table goes: standard output, or a file that is never half of one.
#pragma once

#include <fstream>
#include <ostream>
#include <string>

namespace drover::cli {

/// The file is written beside its name and takes its place when all of it is there: until then, and
/// whatever goes wrong, what has the name stays as it was.
class PoseFile final {
 public:
  /// Empty or "-": standard output. `source` is what the table is made of, and is never written to.
  PoseFile(std::string path, const std::string& source);
  ~PoseFile();
  PoseFile(const PoseFile&) = delete;
  PoseFile& operator=(const PoseFile&) = delete;

  /// Why there is no stream; empty: there is.
  const std::string& problem() const { return problem_; }
  std::ostream& stream();
  /// All of it is in the stream. Returns why it is not where it belongs; empty: it is.
  std::string finish();

 private:
  bool is_printed() const { return path_.empty() || path_ == "-"; }
  void open(const std::string& source);

  std::string path_;
  std::string beside_;  ///< empty: written in place
  std::ofstream file_;
  std::string problem_;
};

}  // namespace drover::cli
