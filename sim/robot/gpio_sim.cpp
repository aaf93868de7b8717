#include "sim/robot/gpio_sim.h"

#include <cstring>
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

}  // namespace

GpioSimChip::GpioSimChip(const GpioSimRoots& roots) : roots_(roots) {
  std::error_code ignored;
  for (const auto& chip : fs::directory_iterator(roots.configfs, ignored))
    for (const auto& bank : fs::directory_iterator(chip.path(), ignored))
      if (bank.is_directory() && first_line(bank.path() / "label") == kChipLabel)
        bank_ = bank.path();
  if (bank_.empty())
    throw std::runtime_error(roots.configfs + ": no gpio-sim chip with the label '" +
                             std::string(kChipLabel) +
                             "'; run inside sim/lab, or use --lines files");
}

fs::path GpioSimChip::line(std::string_view name) const {
  const fs::path chip = fs::path(roots_.devices) / first_line(bank_.parent_path() / "dev_name") /
                        first_line(bank_ / "chip_name");
  for (const auto& line : fs::directory_iterator(bank_))
    if (line.is_directory() && first_line(line.path() / "name") == name)
      return chip / ("sim_gpio" + line.path().filename().string().substr(std::strlen("line")));
  throw std::runtime_error(bank_.string() + ": no line '" + std::string(name) + "'");
}

bool GpioSimChip::set_live(bool live) const {
  std::ofstream stream(bank_.parent_path() / "live");
  stream << (live ? "1" : "0") << std::flush;
  return stream.good();
}

}  // namespace drover::sim
