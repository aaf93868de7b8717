// libgpiod 1.x (Debian 12) and 2.x (Debian 13) behind one seam. Lines are asked for with both
// edges; debouncing is the line drivers' business, since 1.x has none.
#include <gpiod.h>

#include "link/line_number.h"
#include "link/lines.h"

namespace drover::link {

#ifndef DROVER_GPIOD_2

namespace {

/// 1.x asks for each line's level by itself. Where every line tells its edges, one line a call is
/// read, in turn, and all of them after an edge: a level cannot change without one, and a chip that
/// vanished is noticed by any line.
class GpioLines final : public LineLink {
 public:
  GpioLines(gpiod_chip* chip, std::vector<gpiod_line*> lines)
      : chip_(chip), lines_(std::move(lines)) {
    for (auto* line : lines_) {
      const int fd = ::gpiod_line_event_get_fd(line);
      if (fd >= 0) fds_.push_back(fd);
    }
  }
  ~GpioLines() override { ::gpiod_chip_close(chip_); }
  GpioLines(const GpioLines&) = delete;
  GpioLines& operator=(const GpioLines&) = delete;

  bool read(std::array<bool, kMaxLines>& levels) override {
    const bool whole = read_all_ || fds_.size() < lines_.size();
    for (std::size_t n = whole ? lines_.size() : 1; n > 0; --n) {
      next_ = (next_ + 1) % lines_.size();
      const int value = ::gpiod_line_get_value(lines_[next_]);
      if (value < 0) {
        error_ = errno;
        return false;
      }
      levels_[next_] = value == 1;
    }
    read_all_ = false;
    levels = levels_;
    return true;
  }
  std::span<const int> edge_fds() const override { return fds_; }
  void drain_edges(std::array<bool, kMaxLines>& edged) override {
    read_all_ = true;
    constexpr unsigned kEvents = 16;  // the kernel's queue a line
    std::array<gpiod_line_event, kEvents> events{};
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      const timespec no_wait{};
      if (::gpiod_line_event_wait(lines_[i], &no_wait) != 1) continue;
      edged[i] = true;
      (void)::gpiod_line_event_read_multiple(lines_[i], events.data(), kEvents);
    }
  }
  int error() const override { return error_; }

 private:
  gpiod_chip* chip_;
  std::vector<gpiod_line*> lines_;
  std::vector<int> fds_;
  std::array<bool, kMaxLines> levels_{};
  std::size_t next_ = 0;
  bool read_all_ = true;
  int error_ = 0;
};

}  // namespace

Opened<LineLink> open_gpio_lines(const LineSettings& settings) {
  Opened<LineLink> opened;
  gpiod_chip* chip = ::gpiod_chip_open_by_label(settings.chip.c_str());
  if (chip == nullptr) chip = ::gpiod_chip_open_lookup(settings.chip.c_str());
  if (chip == nullptr) {
    opened.problem = no_chip(settings.chip);
    return opened;
  }
  std::vector<gpiod_line*> lines;
  for (const auto& name : settings.lines) {
    gpiod_line* line = ::gpiod_chip_find_line(chip, name.c_str());
    if (const auto number = line_number(name); line == nullptr && number)
      line = ::gpiod_chip_get_line(chip, *number);
    if (line == nullptr) {
      opened.problem = no_line(settings.chip, name);
    } else if (::gpiod_line_request_both_edges_events(line, kConsumer) != 0 &&
               ::gpiod_line_request_input(line, kConsumer) != 0) {
      opened.problem = problem_text("gpio " + settings.chip + " line " + name, "cannot use", errno);
    }
    if (!opened.problem.empty()) {
      ::gpiod_chip_close(chip);
      return opened;
    }
    lines.push_back(line);
  }
  opened.link = std::make_unique<GpioLines>(chip, std::move(lines));
  return opened;
}

#else  // libgpiod 2.x

}  // namespace drover::link

#include <dirent.h>

namespace drover::link {

namespace {

class GpioLines final : public LineLink {
 public:
  GpioLines(gpiod_chip* chip, gpiod_line_request* request, std::vector<unsigned> offsets)
      : chip_(chip),
        request_(request),
        events_(::gpiod_edge_event_buffer_new(64)),
        fd_(::gpiod_line_request_get_fd(request)),
        offsets_(std::move(offsets)) {}
  ~GpioLines() override {
    ::gpiod_edge_event_buffer_free(events_);
    ::gpiod_line_request_release(request_);
    ::gpiod_chip_close(chip_);
  }
  GpioLines(const GpioLines&) = delete;
  GpioLines& operator=(const GpioLines&) = delete;

  bool read(std::array<bool, kMaxLines>& levels) override {
    std::array<gpiod_line_value, kMaxLines> values{};
    if (::gpiod_line_request_get_values(request_, values.data()) != 0) {
      error_ = errno;
      return false;
    }
    for (std::size_t i = 0; i < offsets_.size(); ++i)
      levels[i] = values[i] == GPIOD_LINE_VALUE_ACTIVE;
    return true;
  }
  std::span<const int> edge_fds() const override { return {&fd_, 1}; }
  void drain_edges(std::array<bool, kMaxLines>& edged) override {
    while (::gpiod_line_request_wait_edge_events(request_, 0) == 1) {
      const int count = ::gpiod_line_request_read_edge_events(request_, events_, 64);
      if (count <= 0) return;
      for (int n = 0; n < count; ++n) {
        auto* event = ::gpiod_edge_event_buffer_get_event(events_, static_cast<unsigned long>(n));
        const unsigned offset = ::gpiod_edge_event_get_line_offset(event);
        for (std::size_t i = 0; i < offsets_.size(); ++i)
          if (offsets_[i] == offset) edged[i] = true;
      }
    }
  }
  int error() const override { return error_; }

 private:
  gpiod_chip* chip_;
  gpiod_line_request* request_;
  gpiod_edge_event_buffer* events_;
  int fd_;
  std::vector<unsigned> offsets_;
  int error_ = 0;
};

bool has_label(gpiod_chip* chip, const std::string& wanted) {
  gpiod_chip_info* info = ::gpiod_chip_get_info(chip);
  if (info == nullptr) return false;
  const bool same =
      wanted == ::gpiod_chip_info_get_label(info) || wanted == ::gpiod_chip_info_get_name(info);
  ::gpiod_chip_info_free(info);
  return same;
}

/// 2.x opens by path only: look through /dev for the label or name.
gpiod_chip* find_chip(const std::string& wanted) {
  DIR* folder = ::opendir("/dev");
  if (folder == nullptr) return nullptr;
  gpiod_chip* found = nullptr;
  while (const dirent* entry = ::readdir(folder)) {
    const std::string path = std::string("/dev/") + entry->d_name;
    if (!::gpiod_is_gpiochip_device(path.c_str())) continue;
    gpiod_chip* chip = ::gpiod_chip_open(path.c_str());
    if (chip == nullptr) continue;
    if (has_label(chip, wanted)) {
      found = chip;
      break;
    }
    ::gpiod_chip_close(chip);
  }
  ::closedir(folder);
  return found;
}

gpiod_line_request* request_lines(gpiod_chip* chip, const std::vector<unsigned>& offsets,
                                  gpiod_line_edge edge) {
  gpiod_line_settings* line = ::gpiod_line_settings_new();
  gpiod_line_config* lines = ::gpiod_line_config_new();
  gpiod_request_config* request = ::gpiod_request_config_new();
  ::gpiod_line_settings_set_direction(line, GPIOD_LINE_DIRECTION_INPUT);
  ::gpiod_line_settings_set_edge_detection(line, edge);
  ::gpiod_line_config_add_line_settings(lines, offsets.data(), offsets.size(), line);
  ::gpiod_request_config_set_consumer(request, kConsumer);
  gpiod_line_request* result = ::gpiod_chip_request_lines(chip, request, lines);
  ::gpiod_request_config_free(request);
  ::gpiod_line_config_free(lines);
  ::gpiod_line_settings_free(line);
  return result;
}

}  // namespace

Opened<LineLink> open_gpio_lines(const LineSettings& settings) {
  Opened<LineLink> opened;
  gpiod_chip* chip = find_chip(settings.chip);
  if (chip == nullptr) {
    opened.problem = no_chip(settings.chip);
    return opened;
  }
  std::vector<unsigned> offsets;
  for (const auto& name : settings.lines) {
    int offset = ::gpiod_chip_get_line_offset_from_name(chip, name.c_str());
    if (const auto number = line_number(name); offset < 0 && number)
      offset = static_cast<int>(*number);
    if (offset < 0) {
      opened.problem = no_line(settings.chip, name);
      ::gpiod_chip_close(chip);
      return opened;
    }
    offsets.push_back(static_cast<unsigned>(offset));
  }
  gpiod_line_request* request = request_lines(chip, offsets, GPIOD_LINE_EDGE_BOTH);
  if (request == nullptr) request = request_lines(chip, offsets, GPIOD_LINE_EDGE_NONE);
  if (request == nullptr) {
    opened.problem = problem_text("gpio " + settings.chip, "cannot use its lines", errno);
    ::gpiod_chip_close(chip);
    return opened;
  }
  opened.link = std::make_unique<GpioLines>(chip, request, std::move(offsets));
  return opened;
}

#endif

}  // namespace drover::link
