// The connection to the broker: never blocks, reconnects for ever, drops old telemetry when the
// broker does not take it. Runs inside the publish thread's loop; libmosquitto gets no thread of
// its own.
//
// It speaks MQTT 5, which tells a message that is to be retained from others and does not bring
// stored ones; with a broker that refuses it, 3.1.1, and says what is lost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "config/config.h"
#include "drover/time.h"
#include "publish/arrival.h"
#include "runtime/back_off.h"
#include "runtime/broker_delay.h"
#include "runtime/name_lookup.h"

struct mosquitto;

namespace drover::runtime {

struct MqttMessage {
  std::string_view topic;
  std::string_view payload;
  publish::Retain retain = publish::Retain::no;
};

struct MqttSubscription {
  std::string topic;
  int qos = 0;
};

class MqttClient final {
 public:
  using OnMessage = std::function<void(const MqttMessage&)>;
  using OnState = std::function<void(bool connected, const std::string& text)>;
  /// Whether it tells that droverd is there, and measures the broker by that.
  enum class Presence { told, silent };

  /// Throws std::runtime_error when the client id is not accepted.
  MqttClient(const config::MqttConfig& config, std::vector<MqttSubscription> subscriptions,
             OnMessage on_message, OnState on_state, Presence presence = Presence::told);
  ~MqttClient();
  MqttClient(const MqttClient&) = delete;
  MqttClient& operator=(const MqttClient&) = delete;

  /// Descriptor to watch, -1 while there is none; and whether it wants to write.
  int fd() const;
  bool wants_write() const;
  /// How often a connection was tried: tells a new descriptor from an old one of the same number.
  std::uint64_t connections() const { return connections_; }
  bool connected() const { return connected_; }
  /// Takes what has come, but not more than what leaves time for others.
  void on_readable(Time now);
  void on_writable(Time now);
  /// A few times a second: keepalive, measuring, reconnecting with a growing pause.
  void tick(Time now);

  /// Telemetry: QoS 0, dropped while the last one has not left. True when it was handed over.
  bool publish_latest(const char* topic, const std::string& payload);
  /// Answers: QoS 1, queued by the library; dropped while many are not acknowledged. Empty when it
  /// was taken, otherwise why not.
  std::string_view publish(const char* topic, const std::string& payload, bool retained = false);
  /// Of the answers that are not acknowledged.
  std::size_t bytes_under_way() const { return bytes_under_way_; }
  /// Telemetry that was not handed over, and answers for which there was no place.
  std::uint64_t dropped() const { return dropped_; }
  /// Why nothing that comes now may begin a motion; empty when the broker is prompt.
  std::string_view late(Time now) const { return delay_.late(now); }
  bool just_connected(Duration just, Time now) const { return delay_.just_connected(just, now); }

 private:
  void set_callbacks();
  void connect(Time now);
  bool read_credentials();
  std::string next_address();
  void speak(int version);
  void on_connack(int code);
  void on_connected();
  void on_acknowledged(int message);
  void failed(int code);
  void failed(const std::string& why);

  config::MqttConfig config_;
  std::vector<MqttSubscription> subscriptions_;
  OnMessage on_message_;
  OnState on_state_;
  bool tells_presence_;
  bool open_file_told_ = false;  ///< that others may read the password
  mosquitto* client_ = nullptr;
  int version_ = 0;
  bool connected_ = false;
  bool connecting_ = false;
  int closed_unanswered_ = 0;  ///< connections in a row that ended before the broker said a word
  std::string refusal_;        ///< the broker's, of the present connection
  Time now_ = kNever;          ///< for the library's callbacks
  Time asked_ = kNever;        ///< for the present connection
  BackOff retry_{std::chrono::milliseconds(250), std::chrono::seconds(2)};
  std::string last_text_;
  std::uint64_t connections_ = 0;
  std::uint64_t dropped_ = 0;
  std::map<int, std::size_t> unacknowledged_;  ///< sizes of answers, by the library's number
  std::size_t bytes_under_way_ = 0;
  std::size_t bytes_taken_ = 0;  ///< of messages, in this call of on_readable
  BrokerDelay delay_;
  NameLookup lookup_;
  std::vector<std::string> addresses_;  ///< of the host, the last that were told
  std::size_t next_address_ = 0;
};

}  // namespace drover::runtime
