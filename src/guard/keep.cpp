#include "guard/keep.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace drover::guard {

namespace {

/// Two names, in turn: the next set's words are there before those of the last one go.
constexpr std::array<const char*, 2> kRecipes{"recipe", "recipe.2"};
constexpr const char* kMemory = "memory";
constexpr const char* kState = "state";
constexpr int kWhole = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE;

/// A name as the service manager wants it: no colon, no control character.
std::string link_name(std::string_view link) {
  std::string name = "link." + std::string(link);
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c == ':' || c >= 127; },
      '_');
  return name;
}

/// The set in words, in a file that nobody can change any more; -1 when there is no memory.
int write_recipe(const StopSet& set, std::uint32_t limit_ms, std::uint32_t edition) {
  std::vector<GuardMessage> words(1);
  words[0].verb = GuardVerb::hello;
  words[0].limit_ms = limit_ms;
  words[0].index = edition;
  set.tell(words);
  const int fd = ::memfd_create("drover-guard-recipe", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  const auto size = words.size() * sizeof(GuardMessage);
  if (fd >= 0 && ::write(fd, words.data(), size) == static_cast<ssize_t>(size) &&
      ::fcntl(fd, F_ADD_SEALS, kWhole | F_SEAL_SEAL) == 0)
    return fd;
  if (fd >= 0) ::close(fd);
  return -1;
}

std::vector<GuardMessage> read_recipe(int fd) {
  struct stat info {};
  if (fd < 0 || (::fcntl(fd, F_GET_SEALS) & kWhole) != kWhole || ::fstat(fd, &info) != 0) return {};
  const auto count = static_cast<std::size_t>(info.st_size) / sizeof(GuardMessage);
  if (count > 1 + kGuardMaxLinks + kGuardMaxAxes + kGuardMaxMessages) return {};
  std::vector<GuardMessage> words(count);
  const auto size = count * sizeof(GuardMessage);
  if (::pread(fd, words.data(), size, 0) != static_cast<ssize_t>(size)) return {};
  return words;
}

struct Recipe {
  std::vector<GuardMessage> words;  ///< none: there is no whole one
  std::size_t place = 1;            ///< of its name
};

/// The newer of the two that may be there.
Recipe newest(const std::array<int, kRecipes.size()>& recipes) {
  Recipe newest;
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    auto words = read_recipe(recipes[i]);
    if (words.empty() || words[0].version != kGuardVersion) continue;
    if (newest.words.empty() || words[0].index > newest.words[0].index)
      newest = {std::move(words), i};
  }
  return newest;
}

/// Takes the descriptor out of `kept`; -1 when there is none of this name.
int take(std::vector<Kept>& kept, std::string_view name) {
  for (auto& one : kept)
    if (one.name == name && one.fd >= 0) return std::exchange(one.fd, -1);
  return -1;
}

void understand(const GuardMessage& message, std::vector<Kept>& kept, StopSet& set) {
  if (message.verb == GuardVerb::link) {
    const int fd = is_name(message.name) ? take(kept, link_name(message.name.data())) : -1;
    if (!set.add_link(message, fd) && fd >= 0) ::close(fd);
  } else if (message.verb == GuardVerb::absent) {
    set.add_link(message, -1);
  } else if (message.verb == GuardVerb::axis) {
    set.add_axis(message);
  } else if (message.verb == GuardVerb::stop_message) {
    set.add_message(message);
  }
}

}  // namespace

bool Keep::restore(std::vector<Kept> kept, StopSet& set, std::uint32_t& limit_ms, int& memory) {
  for (const auto& one : kept) stored_.push_back(one.name);
  state_stored_ = map_state(take(kept, kState));
  if (!state_stored_)
    map_state(::memfd_create("drover-guard-state", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  const std::array<int, kRecipes.size()> recipes{take(kept, kRecipes[0]), take(kept, kRecipes[1])};
  const auto [words, place] = newest(recipes);
  const bool understood = words.size() > 1;
  whole_ = place;
  if (!words.empty()) edition_ = words[0].index;
  // Links that are missing are left out: what is there goes on being stopped.
  for (std::size_t i = 1; understood && i < words.size(); ++i) understand(words[i], kept, set);
  if (understood) {
    limit_ms = words[0].limit_ms;
    memory = take(kept, kMemory);
  }
  for (const auto& one : kept)
    if (one.fd >= 0) ::close(one.fd);
  for (const int recipe : recipes)
    if (recipe >= 0) ::close(recipe);
  return understood;
}

/// Takes `fd`.
bool Keep::map_state(int fd) {
  if (fd < 0) return false;
  struct stat info {};
  const bool fresh = ::fstat(fd, &info) == 0 && info.st_size == 0;
  if (fresh && (::ftruncate(fd, sizeof(KeptState)) != 0 ||
                ::fcntl(fd, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW) != 0)) {
    ::close(fd);
    return false;
  }
  void* place = MAP_FAILED;
  if (fresh || info.st_size == static_cast<off_t>(sizeof(KeptState)))
    place = ::mmap(nullptr, sizeof(KeptState), PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  if (place == MAP_FAILED) {
    ::close(fd);
    return false;
  }
  auto* state = static_cast<KeptState*>(place);
  if (state->version.load() != kGuardVersion && !fresh) {
    ::munmap(place, sizeof(KeptState));
    ::close(fd);
    return false;
  }
  state->version.store(kGuardVersion);
  state_ = state;
  state_fd_ = fd;
  return true;
}

void Keep::keep(const StopSet& set, std::uint32_t limit_ms) {
  if (recipe_ >= 0) ::close(recipe_);
  recipe_ = write_recipe(set, limit_ms, ++edition_);
  coming_ = 1 - whole_;
  steps_.clear();
  next_step_ = 0;
  for (const auto name : set.links()) steps_.push_back(link_name(name));
  for (const char* name : {kState, kMemory, kRecipes[coming_]}) steps_.emplace_back(name);
  const auto names = steps_;
  for (const auto& name : stored_)
    if (std::find(names.begin(), names.end(), name) == names.end()) steps_.push_back('-' + name);
  for (const auto& name : names)
    if (std::find(stored_.begin(), stored_.end(), name) == stored_.end()) stored_.push_back(name);
}

void Keep::step(const StopSet& set, int memory) {
  constexpr int kStepsACycle = 2;
  for (int i = 0; i < kStepsACycle && next_step_ < steps_.size(); ++i) {
    if (!take_step(steps_[next_step_], set, memory)) return;
    ++next_step_;
  }
}

bool Keep::take_step(const std::string& step, const StopSet& set, int memory) {
  if (step.front() == '-') {
    if (!notify_.forget(step.substr(1))) return false;  // again, in the next cycle
    std::erase(stored_, step.substr(1));
    return true;
  }
  if (step == kState) {
    if (!state_stored_) state_stored_ = store_anew(step, state_fd_);
    return state_stored_;
  }
  if (step == kRecipes[coming_]) {
    if (!store_anew(step, recipe_)) return false;
    whole_ = coming_;
    return true;
  }
  int fd = step == kMemory ? memory : -1;
  for (const auto link : set.links())
    if (step == link_name(link)) fd = set.descriptor(link);
  return store_anew(step, fd);
}

/// One after the other: a file that is kept already would not be taken under its name again.
bool Keep::store_anew(const std::string& name, int fd) {
  return notify_.forget(name) && (fd < 0 || notify_.store(name, fd));
}

}  // namespace drover::guard
