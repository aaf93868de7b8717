// Writes down all that reaches the gateway and all that it says, so that a run can be played again
// (`drover replay`). The control thread fills a ring and waits for nothing; a thread of its own
// writes. A full ring ends the recording with a mark: what follows could not be replayed.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "drover/path.h"
#include "drover/spsc_ring.h"
#include "gateway/recording/encoder.h"
#include "link/unique_fd.h"
#include "runtime/byte_ring.h"
#include "runtime/wake.h"

namespace drover::runtime {

class Recorder final {
 public:
  /// Into `file`, or, when it is there already, into the first of `file`.1, .2, ... that is not: a
  /// restart does not overwrite what led to it. Throws std::runtime_error.
  Recorder(const std::string& file, const gateway::RecordingHeader& header,
           std::size_t ring_bytes = kRingBytes);

  // Control thread:
  void input(const gateway::Input& input) {
    if (!over_) keep(encoder_->input(input));
  }
  void output(const gateway::Gateway& gateway) {
    if (!over_) keep(encoder_->output(gateway));
  }
  /// Of the thread that makes paths, before it gives the command that names it.
  void path(const Path& path);

  // Recorder thread:
  void run(const std::atomic<bool>& stop);
  void wake() const { wake_.notify(); }

  const std::string& file() const { return file_; }

 private:
  /// Ten seconds of a slow disk.
  static constexpr std::size_t kRingBytes = std::size_t{2} << 20;

  void keep(std::span<const std::uint8_t> record);
  void write_new();
  void write(std::span<const std::uint8_t> bytes);
  void write_record(std::span<const std::uint8_t> record);
  void end_with(gateway::RecordKind kind);

  std::string file_;
  link::UniqueFd fd_;
  std::unique_ptr<gateway::RecordEncoder> encoder_;
  ByteRing ring_;
  bool over_ = false;                ///< control thread: nothing more is kept
  std::atomic<bool> gap_{false};     ///< control, path → recorder
  std::atomic<bool> broken_{false};  ///< recorder → control: the disk takes nothing
  SpscRing<std::vector<std::uint8_t>, 64> paths_;
  Wake wake_;
};

}  // namespace drover::runtime
