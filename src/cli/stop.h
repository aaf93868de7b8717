// `drover stop` and `drover reset`: both programs are told, droverd and drover-guard, so that a
// stop works whatever hangs in one of them.
#pragma once

#include <string>

namespace drover::cli {

struct StopPlaces {
  std::string daemon;  ///< droverd's socket
  std::string guard;   ///< drover-guard's stop socket; empty: "stop.sock" beside the other
  bool json = false;
};

/// Done when either obeyed; says which did and why the other did not. Returns the exit code.
int stop(const StopPlaces& places);
/// Both latches end, droverd's first: what it refuses leaves both as they were. The guard's alone
/// when droverd does not answer. Returns the exit code.
int reset(const StopPlaces& places);

}  // namespace drover::cli
