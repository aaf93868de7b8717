#include "sim/scenario/operator_client.h"

#include <mosquitto.h>

#include <stdexcept>

namespace drover::sim {

OperatorClient::OperatorClient(int port, OnMessage on_message)
    : port_(port), on_message_(std::move(on_message)) {
  ::mosquitto_lib_init();
  client_ = ::mosquitto_new("operator", true, this);
  if (client_ == nullptr) throw std::runtime_error("cannot make an MQTT client");
  ::mosquitto_int_option(client_, MOSQ_OPT_TCP_NODELAY, 1);
  ::mosquitto_connect_callback_set(client_, &OperatorClient::on_connect);
  ::mosquitto_subscribe_callback_set(client_, &OperatorClient::on_subscribe);
  ::mosquitto_disconnect_callback_set(client_, &OperatorClient::on_disconnect);
  ::mosquitto_message_callback_set(client_, &OperatorClient::on_message);
}

OperatorClient::~OperatorClient() {
  ::mosquitto_destroy(client_);
  ::mosquitto_lib_cleanup();
}

void OperatorClient::connect() {
  if (descriptor() >= 0) return;
  (void)::mosquitto_connect(client_, "127.0.0.1", port_, 60);
}

int OperatorClient::descriptor() const {
  return ::mosquitto_socket(client_);
}

bool OperatorClient::wants_to_write() const {
  return ::mosquitto_want_write(client_);
}

void OperatorClient::serve(bool readable, bool writable) {
  if (descriptor() < 0) return;
  if (readable) (void)::mosquitto_loop_read(client_, 1);
  if (writable) (void)::mosquitto_loop_write(client_, 1);
  if (!readable && !writable) (void)::mosquitto_loop_misc(client_);
}

bool OperatorClient::publish(const std::string& topic, std::string_view payload, bool retain) {
  return subscribed_ &&
         ::mosquitto_publish(client_, nullptr, topic.c_str(), static_cast<int>(payload.size()),
                             payload.data(), 0, retain) == MOSQ_ERR_SUCCESS;
}

void OperatorClient::on_connect(mosquitto* client, void*, int code) {
  if (code == 0) (void)::mosquitto_subscribe(client, nullptr, "#", 0);
}

void OperatorClient::on_subscribe(mosquitto*, void* self, int, int, const int*) {
  static_cast<OperatorClient*>(self)->subscribed_ = true;
}

void OperatorClient::on_disconnect(mosquitto*, void* self, int) {
  static_cast<OperatorClient*>(self)->subscribed_ = false;
}

void OperatorClient::on_message(mosquitto*, void* self, const mosquitto_message* message) {
  static_cast<OperatorClient*>(self)->on_message_(
      {message->topic,
       {static_cast<const char*>(message->payload), static_cast<std::size_t>(message->payloadlen)},
       message->retain});
}

}  // namespace drover::sim
