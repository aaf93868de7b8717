// One question to droverd over its Unix socket, one answer.
#pragma once

#include <string>

#include "json/located_json.h"
#include "link/unique_fd.h"

namespace drover::cli {

/// The daemon has not answered: the sentence says why.
struct NoAnswer {
  std::string text;
  bool asked = false;   ///< it may have done what was asked for
  bool absent = false;  ///< nobody listens there
};

/// How long an answer that waits for the disk may take.
inline constexpr int kDiskPatience_s = 20;

/// One connection for many requests, one after the other.
class Connection final {
 public:
  /// Throws NoAnswer.
  explicit Connection(const std::string& socket_path, int patience_s = 10);
  /// As the function below.
  std::string ask(const std::string& request);

 private:
  NoAnswer unanswered(int error) const;

  std::string path_;
  int patience_s_;
  link::UniqueFd fd_;
};

/// Sends `request` (one JSON line) and waits for the reply. Throws NoAnswer.
std::string ask(const std::string& socket_path, const std::string& request, int patience_s = 10);

}  // namespace drover::cli
