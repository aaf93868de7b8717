#include "sim/robot/line_port.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace drover::sim {
namespace {

namespace fs = std::filesystem;

link::UniqueFd open_or_throw(const fs::path& path, int flags) {
  link::UniqueFd fd(::open(path.c_str(), flags | O_CLOEXEC, 0644));
  if (!fd) throw std::runtime_error(path.string() + ": cannot open: " + std::strerror(errno));
  return fd;
}

}  // namespace

LinePort LinePort::gpio_sim(const Scenario& scenario, const GpioSimChip& chip) {
  LinePort port;
  port.high_text_ = "pull-up";
  port.low_text_ = "pull-down";
  for (std::size_t i = 0; i < kLineNames; ++i)
    if (scenario.lines[i].wired)
      port.fds_[i] = open_or_throw(chip.line(kLineText[i]) / "pull", O_WRONLY);
  return port;
}

LinePort LinePort::files(const Scenario& scenario, const std::string& folder) {
  LinePort port;
  port.high_text_ = "1";
  port.low_text_ = "0";
  fs::create_directories(folder);
  for (std::size_t i = 0; i < kLineNames; ++i)
    if (scenario.lines[i].wired)
      port.fds_[i] = open_or_throw(fs::path(folder) / kLineText[i], O_WRONLY | O_CREAT);
  return port;
}

void LinePort::set(LineName line, bool high) {
  const auto i = static_cast<std::size_t>(line);
  if (!fds_[i] || written_[i] == high) return;
  const auto& text = high ? high_text_ : low_text_;
  if (::pwrite(fds_[i].get(), text.data(), text.size(), 0) == static_cast<ssize_t>(text.size()))
    written_[i] = high;  // otherwise tried again at the next tick
}

}  // namespace drover::sim
