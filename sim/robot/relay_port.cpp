#include "sim/robot/relay_port.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace drover::sim {
namespace {

constexpr const char* kName = "enable_relay";

}  // namespace

RelayPort::RelayPort(const GpioSimChip& chip) {
  reopen(chip);
}

RelayPort::RelayPort(std::string folder) : file_(std::move(folder) + "/" + kName) {}

void RelayPort::reopen(const GpioSimChip& chip) {
  const auto path = (chip.line(kName) / "value").string();
  level_ = link::UniqueFd(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!level_) throw std::runtime_error(path + ": cannot open: " + std::strerror(errno));
}

bool RelayPort::closed() {
  if (!level_ && !file_.empty())
    level_ = link::UniqueFd(::open(file_.c_str(), O_RDONLY | O_CLOEXEC));
  char level = '0';
  return level_ && ::pread(level_.get(), &level, 1, 0) == 1 && level == '1';
}

}  // namespace drover::sim
