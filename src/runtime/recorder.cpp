#include "runtime/recorder.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "link/opened.h"
#include "runtime/log.h"

namespace drover::runtime {

namespace {

/// What a killed daemon has not written is at most so old.
constexpr int kWriteEach_ms = 50;
constexpr int kMostFiles = 1000;

link::UniqueFd create(std::string& file) {
  const std::string wanted = file;
  for (int i = 1; i < kMostFiles; ++i) {
    link::UniqueFd fd(::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
    if (fd) return fd;
    if (errno != EEXIST) throw std::runtime_error(link::problem_text(file, "cannot record", errno));
    file = wanted + "." + std::to_string(i);
  }
  throw std::runtime_error(wanted + ": cannot record: there are too many of this name");
}

}  // namespace

Recorder::Recorder(const std::string& file, const gateway::RecordingHeader& header,
                   std::size_t ring_bytes)
    : file_(file),
      fd_(create(file_)),
      encoder_(std::make_unique<gateway::RecordEncoder>()),
      ring_(ring_bytes) {
  if (header.fields.size() > gateway::kMaxFields)
    throw std::runtime_error("too many values for a recording");
  write(gateway::written(header));
}

void Recorder::keep(std::span<const std::uint8_t> record) {
  std::array<std::uint8_t, 10> length{};
  gateway::ByteWriter head(length);
  head.number(record.size());
  const bool kept = !record.empty() && !broken_.load(std::memory_order_relaxed) &&
                    ring_.push(head.written(), record);
  if (kept) return;
  over_ = true;
  gap_.store(true, std::memory_order_release);
}

void Recorder::path(const Path& path) {
  if (!paths_.push(gateway::written(path))) gap_.store(true, std::memory_order_release);
}

void Recorder::run(const std::atomic<bool>& stop) {
  while (fd_) {
    const bool last = stop.load(std::memory_order_acquire);
    write_new();
    if (last || !fd_) break;
    pollfd fd{wake_.fd(), POLLIN, 0};
    if (::poll(&fd, 1, kWriteEach_ms) > 0) wake_.clear();
  }
  end_with(gateway::RecordKind::end);
}

/// A path is in its ring before the command that names it is in the other.
void Recorder::write_new() {
  const bool gap = gap_.load(std::memory_order_acquire);
  const auto until = ring_.filled_until();
  std::vector<std::uint8_t> path;
  while (paths_.pop(path)) write_record(path);
  ring_.drain(until, [this](std::span<const std::uint8_t> bytes) { write(bytes); });
  if (gap) end_with(gateway::RecordKind::gap);
}

void Recorder::write_record(std::span<const std::uint8_t> record) {
  std::array<std::uint8_t, 10> length{};
  gateway::ByteWriter head(length);
  head.number(record.size());
  write(head.written());
  write(record);
}

void Recorder::write(std::span<const std::uint8_t> bytes) {
  while (fd_ && !bytes.empty()) {
    const auto n = ::write(fd_.get(), bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      log(LogLevel::warning, link::problem_text(file_, "the recording ends", errno));
      broken_.store(true, std::memory_order_relaxed);
      fd_ = {};
      return;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void Recorder::end_with(gateway::RecordKind kind) {
  if (!fd_) return;
  const std::array<std::uint8_t, 1> mark{static_cast<std::uint8_t>(kind)};
  write_record(mark);
  broken_.store(true, std::memory_order_relaxed);
  fd_ = {};
  if (kind == gateway::RecordKind::gap)
    log(LogLevel::warning, file_ + ": the disk is too slow, the recording ends with a gap");
}

}  // namespace drover::runtime
