#include "sim/robot/output_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace drover::sim {

OutputLog::OutputLog(const std::string& path, const GpioSimChip& chip) : log_(path) {
  reopen(chip);
}

void OutputLog::reopen(const GpioSimChip& chip) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const auto file = chip.line(kOutputText[i]) / "value";
    values_[i] = link::UniqueFd(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (!values_[i])
      throw std::runtime_error(file.string() + ": cannot open: " + std::strerror(errno));
  }
}

void OutputLog::sample(Time now) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    char level = '-';
    if (::pread(values_[i].get(), &level, 1, 0) != 1) level = '-';
    if (level == levels_[i]) continue;
    levels_[i] = level;
    std::string line;
    append_stamp(line, now);
    line += kOutputText[i];
    line += {' ', level, '\n'};
    log_.append(line);
  }
}

}  // namespace drover::sim
