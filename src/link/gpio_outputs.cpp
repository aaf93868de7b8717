// Outputs through the kernel's own interface (GPIO character device, version 2; Linux 5.10), since
// the guard is given the line handle and libgpiod 1.x keeps it to itself.
#include <dirent.h>
#include <fcntl.h>
#include <linux/gpio.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "link/line_number.h"
#include "link/lines.h"
#include "link/outputs.h"

namespace drover::link {

namespace {

/// A line handle of the kernel, and which of the outputs are its lines.
struct Handle {
  UniqueFd fd;
  std::vector<std::size_t> lines;
};

class GpioOutputs final : public OutputLink {
 public:
  GpioOutputs(Handle own, Handle shared) : handles_{std::move(own), std::move(shared)} {}
  bool write(std::span<const bool> levels) override {
    for (const auto& handle : handles_)
      if (handle.fd && !write(handle, levels)) return false;
    return true;
  }
  bool is_on(std::size_t line) const override {
    for (const auto& handle : handles_) {
      const auto place = std::find(handle.lines.begin(), handle.lines.end(), line);
      if (!handle.fd || place == handle.lines.end()) continue;
      gpio_v2_line_values values{};
      values.mask = std::uint64_t{1} << (place - handle.lines.begin());
      return ::ioctl(handle.fd.get(), GPIO_V2_LINE_GET_VALUES_IOCTL, &values) == 0 &&
             (values.bits & values.mask) != 0;
    }
    return false;
  }
  int error() const override { return error_; }
  int fd() const override { return handles_[0].fd.get(); }
  int shared_fd() const override { return handles_[1].fd.get(); }

 private:
  bool write(const Handle& handle, std::span<const bool> levels) {
    gpio_v2_line_values values{};
    values.mask = (std::uint64_t{1} << handle.lines.size()) - 1;
    for (std::size_t i = 0; i < handle.lines.size(); ++i)
      if (handle.lines[i] < levels.size() && levels[handle.lines[i]])
        values.bits |= std::uint64_t{1} << i;
    if (::ioctl(handle.fd.get(), GPIO_V2_LINE_SET_VALUES_IOCTL, &values) == 0) return true;
    error_ = errno;
    return false;
  }

  std::array<Handle, 2> handles_;
  int error_ = 0;
};

/// For hosts without GPIO: each line a file whose first byte is '0' or '1', electrically.
class FileOutputs final : public OutputLink {
 public:
  FileOutputs(std::vector<UniqueFd> files, const std::vector<OutputLine>& lines)
      : files_(std::move(files)), lines_(lines) {}
  bool write(std::span<const bool> levels) override {
    for (std::size_t i = 0; i < std::min(levels.size(), files_.size()); ++i) {
      const char level = levels[i] != lines_[i].active_low ? '1' : '0';
      if (::pwrite(files_[i].get(), &level, 1, 0) != 1) {
        error_ = errno;
        return false;
      }
    }
    return true;
  }
  bool is_on(std::size_t line) const override {
    char level = 0;
    return line < files_.size() && ::pread(files_[line].get(), &level, 1, 0) == 1 &&
           level == (lines_[line].active_low ? '0' : '1');
  }
  int error() const override { return error_; }

 private:
  std::vector<UniqueFd> files_;
  std::vector<OutputLine> lines_;
  int error_ = 0;
};

bool is_named(int chip, const std::string& wanted) {
  gpiochip_info info{};
  return ::ioctl(chip, GPIO_GET_CHIPINFO_IOCTL, &info) == 0 &&
         (wanted == info.label || wanted == info.name);
}

UniqueFd find_chip(const std::string& wanted) {
  DIR* folder = ::opendir("/dev");
  if (folder == nullptr) return {};
  UniqueFd found;
  while (const dirent* entry = ::readdir(folder)) {
    if (std::strncmp(entry->d_name, "gpiochip", 8) != 0) continue;
    UniqueFd chip(::open((std::string("/dev/") + entry->d_name).c_str(), O_RDWR | O_CLOEXEC));
    if (!chip || !is_named(chip.get(), wanted)) continue;
    found = std::move(chip);
    break;
  }
  ::closedir(folder);
  return found;
}

/// Offset of the line with this name, or of this number; -1: there is none.
int find_line(int chip, const std::string& name) {
  gpiochip_info info{};
  if (::ioctl(chip, GPIO_GET_CHIPINFO_IOCTL, &info) != 0) return -1;
  for (std::uint32_t offset = 0; offset < info.lines; ++offset) {
    gpio_v2_line_info line{};
    line.offset = offset;
    if (::ioctl(chip, GPIO_V2_GET_LINEINFO_IOCTL, &line) == 0 && name == line.name)
      return static_cast<int>(offset);
  }
  const auto number = line_number(name);
  return number && *number < info.lines ? static_cast<int>(*number) : -1;
}

/// Requests these lines of the settings; an invalid one with the sentence in `problem`.
UniqueFd request_lines(int chip, const OutputSettings& settings,
                       const std::vector<std::size_t>& lines, std::string& problem) {
  gpio_v2_line_request request{};
  std::strncpy(request.consumer, kConsumer, sizeof request.consumer - 1);
  request.config.flags = GPIO_V2_LINE_FLAG_OUTPUT;
  std::uint64_t active_low = 0;
  for (const auto index : lines) {
    const auto& line = settings.lines[index];
    const int offset = find_line(chip, line.name);
    if (offset < 0) {
      problem = no_line(settings.chip, line.name);
      return {};
    }
    if (line.active_low) active_low |= std::uint64_t{1} << request.num_lines;
    request.offsets[request.num_lines++] = static_cast<std::uint32_t>(offset);
  }
  // All off from the first moment: logical 0, whatever the polarity.
  request.config.num_attrs = 1;
  request.config.attrs[0].attr.id = GPIO_V2_LINE_ATTR_ID_OUTPUT_VALUES;
  request.config.attrs[0].attr.values = 0;
  request.config.attrs[0].mask = (std::uint64_t{1} << request.num_lines) - 1;
  if (active_low != 0) {
    request.config.num_attrs = 2;
    request.config.attrs[1].attr.id = GPIO_V2_LINE_ATTR_ID_FLAGS;
    request.config.attrs[1].attr.flags = GPIO_V2_LINE_FLAG_OUTPUT | GPIO_V2_LINE_FLAG_ACTIVE_LOW;
    request.config.attrs[1].mask = active_low;
  }
  if (::ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &request) == 0) return UniqueFd(request.fd);
  problem = problem_text("gpio " + settings.chip, "cannot use its outputs", errno);
  return {};
}

Opened<OutputLink> open_gpio(const OutputSettings& settings, UniqueFd kept) {
  Opened<OutputLink> opened;
  const UniqueFd chip = find_chip(settings.chip);
  if (!chip) {
    opened.problem = no_chip(settings.chip);
    return opened;
  }
  Handle own;
  Handle shared{std::move(kept), {}};
  for (std::size_t i = 0; i < settings.lines.size(); ++i)
    (static_cast<int>(i) == settings.shared_line ? shared : own).lines.push_back(i);
  for (auto* handle : {&shared, &own}) {
    if (handle->fd || handle->lines.empty()) continue;
    handle->fd = request_lines(chip.get(), settings, handle->lines, opened.problem);
    if (!handle->fd) return opened;
  }
  opened.link = std::make_unique<GpioOutputs>(std::move(own), std::move(shared));
  return opened;
}

Opened<OutputLink> open_files(const OutputSettings& settings) {
  Opened<OutputLink> opened;
  std::vector<UniqueFd> files;
  for (const auto& line : settings.lines) {
    const auto path = settings.chip.substr(kFilesPrefix.size()) + "/" + line.name;
    UniqueFd fd(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
    if (!fd) {
      opened.problem = problem_text(path, "cannot open", errno);
      return opened;
    }
    files.push_back(std::move(fd));
  }
  opened.link = std::make_unique<FileOutputs>(std::move(files), settings.lines);
  return opened;
}

}  // namespace

Opened<OutputLink> open_outputs(const OutputSettings& settings, UniqueFd shared) {
  return settings.chip.starts_with(kFilesPrefix) ? open_files(settings)
                                                 : open_gpio(settings, std::move(shared));
}

}  // namespace drover::link
