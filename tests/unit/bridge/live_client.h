#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace skein::bridge {

/// A browser's end of the WebSocket. Nothing here waits longer than 10 s.
class LiveClient {
 public:
  /// @param origin header, "" for none. @param receive_buffer_bytes 0: what the kernel thinks right; little,
  /// and the bridge soon notices when nobody reads here. @param token "" for none. Throws when the upgrade is
  /// refused.
  explicit LiveClient(std::uint16_t port, const std::string& origin = "", const std::string& target = "/live",
                      int receive_buffer_bytes = 0, const std::string& token = "");
  ~LiveClient();

  struct Message {
    bool binary = false;
    std::string bytes;
  };
  /// What the bridge packed comes unpacked. None when the connection has ended.
  std::optional<Message> Read();
  /// The next text of a type; others are skipped. Null when the connection has ended.
  nlohmann::json ReadText(const std::string& type);
  /// The next binary frame of a kind; "" when the connection has ended.
  std::string ReadBinary(char kind);

  void Send(const std::string& text, bool binary = false);
  /// Past the WebSocket, straight into the TCP connection.
  void SendRaw(const std::string& bytes);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace skein::bridge
