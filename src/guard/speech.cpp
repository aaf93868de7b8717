#include "guard/speech.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace drover::guard {

namespace {
/// Locked memory is counted: eight megabytes of stack, as is usual, would be too much.
constexpr std::size_t kStackBytes = std::size_t{256} * 1024;
}  // namespace

Speech::Speech() : wake_(::eventfd(0, EFD_CLOEXEC | EFD_SEMAPHORE)) {
  pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, kStackBytes);
  ::pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  pthread_t thread{};
  if (::pthread_create(&thread, &attributes, write_lines, this) == 0)
    ::pthread_setname_np(thread, "guard-speech");
  ::pthread_attr_destroy(&attributes);
}

void Speech::say(const char* pattern, ...) {
  std::array<char, 240> text{};
  va_list args;
  va_start(args, pattern);
  const int n = std::vsnprintf(text.data(), text.size(), pattern, args);
  va_end(args);
  if (unsaid_ > told_) {
    Line gap;
    gap.format("drover-guard: %llu lines could not be said",
               static_cast<unsigned long long>(unsaid_ - told_));
    if (lines_.push(gap)) {
      told_ = unsaid_;
      ::eventfd_write(wake_, 1);
    }
  }
  const auto size = static_cast<std::size_t>(std::clamp(n, 0, static_cast<int>(text.size()) - 1));
  if (!lines_.push(Line(std::string_view(text.data(), size)))) {
    ++unsaid_;
    return;
  }
  ::eventfd_write(wake_, 1);  // far from its limit: the ring is full long before
}

void* Speech::write_lines(void* self) {
  auto& speech = *static_cast<Speech*>(self);
  for (;;) {
    eventfd_t one = 0;
    if (::eventfd_read(speech.wake_, &one) != 0) return nullptr;
    Line line;
    if (!speech.lines_.pop(line)) continue;
    const std::string text = std::string(line.view()) + "\n";
    // What stderr does not take is lost: there is nobody else to be told.
    (void)!::write(STDERR_FILENO, text.data(), text.size());
  }
}

}  // namespace drover::guard
