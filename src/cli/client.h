// One question to droverd over its Unix socket, one answer.
#pragma once

#include <string>

#include "json/located_json.h"

namespace drover::cli {

/// The daemon could not be asked: the sentence says why.
struct NoAnswer {
  std::string text;
};

/// How long an answer that waits for the disk may take.
inline constexpr int kDiskPatience_s = 20;

/// Sends `request` (one JSON line) and waits for the reply. Throws NoAnswer.
std::string ask(const std::string& socket_path, const std::string& request, int patience_s = 10);

}  // namespace drover::cli
