// Asks droverd's command-line socket for its status, without ever waiting for it.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "link/unique_fd.h"

namespace drover::sim {

class StatusClient {
 public:
  explicit StatusClient(std::string socket_path) : path_(std::move(socket_path)) {}

  /// Sends a question, unless the last one is not answered yet or nobody listens.
  void ask();
  /// -1: nothing is on its way.
  int descriptor() const { return fd_.get(); }
  void on_readable();
  /// The last answer's result; null before the first and when droverd went away.
  const nlohmann::json& status() const { return status_; }

 private:
  std::string path_;
  link::UniqueFd fd_;
  std::string reply_;
  nlohmann::json status_;
};

}  // namespace drover::sim
