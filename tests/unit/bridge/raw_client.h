#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace skein::bridge {

struct RawResponse {
  int status = 0;
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
};

/// A TCP connection that sends whatever it is told to. Nothing here waits longer than 10 s.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port);
  ~RawClient();
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  /// False when the other side has closed.
  bool Send(std::string_view bytes);
  /// Sends no more.
  void EndSending();

  /// The next response; none when the connection ends before there is one. @param head it has no body,
  /// whatever its length says.
  std::optional<RawResponse> Receive(bool head = false);
  /// Whether the other side closes (in good order or not) and sends nothing more before.
  bool IsClosed();

  /// "GET target HTTP/1.1" with a good Host header, and the response.
  std::optional<RawResponse> Get(std::string_view target, std::string_view more_headers = "");
  std::optional<RawResponse> Post(std::string_view target, std::string_view body,
                                  std::string_view more_headers = "");

 private:
  bool Read();

  int socket_;
  std::string received_;
};

}  // namespace skein::bridge
