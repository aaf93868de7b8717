// Every field of a configuration struct is a key, and no key sets the field of another.
#include "config/fields.h"

#include <gtest/gtest.h>

#include <map>
#include <type_traits>
#include <utility>

namespace drover::config {
namespace {

/// Converts to whatever a field is; never run.
struct Anything {
  template <class T>
  operator T() const;
};

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
  return requires {
    T{((void)I, Anything{})...};
  };
}

/// Number of fields of an aggregate without arrays.
template <class T, std::size_t N = 0>
constexpr std::size_t field_count() {
  static_assert(std::is_aggregate_v<T>);
  if constexpr (takes<T>(std::make_index_sequence<N + 1>{})) {
    return field_count<T, N + 1>();
  } else {
    return N;
  }
}

/// A visitor that writes down where each key's value lives.
class Places final {
 public:
  void number(std::string_view key, double& value, Range range, std::string_view text,
              Presence = Presence::optional) {
    add(key, &value, text);
    EXPECT_LE(range.min, value) << key << ": the default is outside the range";
    EXPECT_GE(range.max, value) << key << ": the default is outside the range";
  }
  void integer(std::string_view key, int& value, Range range, std::string_view text,
               Presence = Presence::optional) {
    add(key, &value, text);
    EXPECT_LE(range.min, value) << key << ": the default is outside the range";
    EXPECT_GE(range.max, value) << key << ": the default is outside the range";
  }
  void choice(std::string_view key, std::string& value, const std::vector<std::string>& choices,
              std::string_view text, Presence presence = Presence::optional) {
    add(key, &value, text);
    if (presence == Presence::required || value.empty()) return;  // it has no default
    EXPECT_EQ(std::count(choices.begin(), choices.end(), value), 1)
        << key << ": the default is no choice";
  }
  template <class T>
  void options(std::string_view key, T& value, const std::string&) {
    add(key, &value, "options");
  }
  template <class T>
  void names(std::string_view key, T& value, Count, std::string_view text,
             Presence = Presence::optional) {
    add(key, &value, text);
  }
  template <class T>
  void list(std::string_view key, T& value, Count, std::string_view text, Presence) {
    add(key, &value, text);
  }
  template <class T>
  void table(std::string_view key, T& value, Count, std::string_view text,
             Presence = Presence::optional) {
    add(key, &value, text);
  }
  template <class T>
  void others(T& value, std::size_t, std::string_view text) {
    add("*", &value, text);
  }
  void keys_of_kind(const std::string&) {}
  void keys_of_base(const std::string&) {}
  template <class T>
  void object(std::string_view key, T& value, std::string_view text,
              Presence = Presence::optional) {
    add(key, &value, text);
  }
  template <class T>
  void flag(std::string_view key, T& value, std::string_view text, Presence = Presence::optional) {
    add(key, &value, text);
  }
  template <class T>
  void text(std::string_view key, T& value, std::string_view what, Presence = Presence::optional) {
    add(key, &value, what);
  }

  std::size_t count() const { return keys_.size(); }

 private:
  void add(std::string_view key, const void* place, std::string_view text) {
    EXPECT_FALSE(text.empty()) << key << ": no meaning";
    const auto [it, inserted] = places_.emplace(place, key);
    EXPECT_TRUE(inserted) << key << " sets the same field as " << it->second;
    EXPECT_TRUE(keys_.emplace(key, place).second) << key << ": two fields of this name";
  }
  std::map<const void*, std::string> places_;
  std::map<std::string, const void*, std::less<>> keys_;
};

template <class T>
std::size_t key_count() {
  T value;
  Places places;
  visit(places, value);
  return places.count();
}

/// `others`: fields that are no keys because they follow from something else.
template <class T>
void expect_complete(std::size_t others = 0) {
  EXPECT_EQ(key_count<T>() + others, field_count<T>());
}

TEST(Fields, AreCounted) {
  struct Three {
    double a = 1;
    std::string b;
    std::vector<int> c;
  };
  EXPECT_EQ(field_count<Three>(), 3u);
}

TEST(Fields, OfTheEngineAreAllKeys) {
  expect_complete<engine::LimitsConfig>();
  expect_complete<engine::EstimateConfig>(1);  // antennas are of the devices
  expect_complete<engine::NavigateConfig>();
  expect_complete<engine::HealthConfig>(1);  // guard_required is guard.required
}

TEST(Fields, OfTheDaemonAreAllKeys) {
  expect_complete<PathsConfig>();
  expect_complete<ControlConfig>();
  expect_complete<LinkConfig>(2);   // name, wire
  expect_complete<JointConfig>(2);  // name, channel_index
  // name, kind, link_index, first_axis, goes_on_in_silence, stops_after_ms, registers
  expect_complete<DeviceConfig>(7);
  expect_complete<GuardConfig>();
  expect_complete<MqttConfig>();
  expect_complete<ProtocolConfig>();
}

TEST(Fields, OfRos2AreAllKeys) {
  expect_complete<Ros2InputsConfig>();
  expect_complete<Ros2Config>(1);  // configured, which follows
}

TEST(Fields, OfTheSceneAreAllKeys) {
  expect_complete<CornerConfig>();
  expect_complete<FrameConfig>(1);  // name
  // Not configured, which follows; of the engine's part not max_age_s and silent_s, which are
  // fixed, nor beside_m and reach_m, which follow.
  EXPECT_EQ(key_count<SceneConfig>(),
            field_count<SceneConfig>() - 2 + field_count<engine::ClearanceConfig>() - 4);
}

TEST(Fields, OfAScannersFieldAreAllKeys) {
  expect_complete<FieldConfig>();
}

TEST(Fields, OfTheBaseAreAllKeys) {
  engine::BaseConfig base;
  BaseNames names;
  names.base = &base;
  Places places;
  visit(places, names);
  EXPECT_EQ(places.count(), field_count<engine::BaseConfig>() + 1);  // device, by name
}

TEST(Fields, OfAJointOutsideTheBaseAreAllKeys) {
  // All but its axis, which is a name, and what its drive can be told, which its driver says.
  EXPECT_EQ(key_count<GroupJoint>(), field_count<engine::JointRules>() - 2);
  expect_complete<JointGroup>(1);  // name
}

TEST(Fields, OfTheWholeAreAllKeysOrSections) {
  DroverConfig config;
  GroupNames groups;
  Places places;
  visit(places, config, groups);
  // The engine's four parts and the groups are sections of their own, and its struct is none; what
  // else it holds follows from other keys.
  EXPECT_EQ(places.count(), field_count<DroverConfig>() - 1 + 5);
}

}  // namespace
}  // namespace drover::config
