// The connection to the broker: never blocks, reconnects for ever, drops old telemetry when the
// broker does not take it. Runs inside the publish thread's loop; libmosquitto gets no thread of
// its own.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"
#include "drover/time.h"

struct mosquitto;

namespace drover::runtime {

struct MqttMessage {
  std::string_view topic;
  std::string_view payload;
  bool retained = false;
};

struct MqttSubscription {
  std::string topic;
  int qos = 0;
};

class MqttClient final {
 public:
  using OnMessage = std::function<void(const MqttMessage&)>;
  using OnState = std::function<void(bool connected, const std::string& text)>;

  /// Throws std::runtime_error when the client id is not accepted.
  MqttClient(const config::MqttConfig& config, std::vector<MqttSubscription> subscriptions,
             OnMessage on_message, OnState on_state);
  ~MqttClient();
  MqttClient(const MqttClient&) = delete;
  MqttClient& operator=(const MqttClient&) = delete;

  /// Descriptor to watch, -1 while there is none; and whether it wants to write.
  int fd() const;
  bool wants_write() const;
  /// How often a connection was tried: tells a new descriptor from an old one of the same number.
  std::uint64_t connections() const { return connections_; }
  bool connected() const { return connected_; }
  void on_readable();
  void on_writable();
  /// A few times a second: keepalive, reconnecting with a growing pause.
  void tick(Time now);

  /// Telemetry: QoS 0, dropped while the last one has not left. True when it was handed over.
  bool publish_latest(const char* topic, const std::string& payload);
  /// Answers: QoS 1, queued by the library.
  bool publish(const char* topic, const std::string& payload, bool retained = false);
  std::uint64_t dropped() const { return dropped_; }

 private:
  void connect(Time now);
  void failed(int code);
  void failed(const std::string& why);

  config::MqttConfig config_;
  std::vector<MqttSubscription> subscriptions_;
  OnMessage on_message_;
  OnState on_state_;
  mosquitto* client_ = nullptr;
  bool connected_ = false;
  bool connecting_ = false;
  Time next_try_ = kNever;
  Duration pause_{};
  std::string last_text_;
  std::uint64_t connections_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace drover::runtime
