#include "sim/robot/line_port.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace drover::sim {
namespace {

namespace fs = std::filesystem;
constexpr std::string_view kChipLabel = "drover-sim";

std::string first_line(const fs::path& path) {
  std::ifstream stream(path);
  std::string line;
  std::getline(stream, line);
  return line;
}

link::UniqueFd open_or_throw(const fs::path& path, int flags) {
  link::UniqueFd fd(::open(path.c_str(), flags | O_CLOEXEC, 0644));
  if (!fd) throw std::runtime_error(path.string() + ": cannot open: " + std::strerror(errno));
  return fd;
}

fs::path find_bank(const std::string& configfs) {
  std::error_code ignored;
  for (const auto& chip : fs::directory_iterator(configfs, ignored))
    for (const auto& bank : fs::directory_iterator(chip.path(), ignored))
      if (bank.is_directory() && first_line(bank.path() / "label") == kChipLabel)
        return bank.path();
  throw std::runtime_error(configfs + ": no gpio-sim chip with the label '" +
                           std::string(kChipLabel) + "'; run inside sim/lab, or use --lines files");
}

}  // namespace

LinePort LinePort::gpio_sim(const Scenario& scenario, const std::string& configfs,
                            const std::string& devices) {
  LinePort port;
  port.high_text_ = "pull-up";
  port.low_text_ = "pull-down";
  const fs::path bank = find_bank(configfs);
  const fs::path chip = fs::path(devices) / first_line(bank.parent_path() / "dev_name") /
                        first_line(bank / "chip_name");
  for (std::size_t i = 0; i < kLineNames; ++i) {
    if (!scenario.lines[i].wired) continue;
    std::string offset;
    for (const auto& line : fs::directory_iterator(bank))
      if (line.is_directory() && first_line(line.path() / "name") == kLineText[i])
        offset = line.path().filename().string().substr(std::strlen("line"));
    if (offset.empty())
      throw std::runtime_error(bank.string() + ": no line '" + std::string(kLineText[i]) + "'");
    port.fds_[i] = open_or_throw(chip / ("sim_gpio" + offset) / "pull", O_WRONLY);
  }
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
