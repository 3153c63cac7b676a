#include "bridge/file_download.h"

#include <algorithm>
#include <boost/asio/write.hpp>
#include <boost/beast/core/file_posix.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/write.hpp>
#include <chrono>
#include <string>

#include "bridge/await.h"

namespace skein::bridge {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;

constexpr std::uint64_t kPieceBytes = 256 * 1024;
// Of one piece: 70 kbit/s.
constexpr std::chrono::seconds kPieceTime{30};

}  // namespace

asio::awaitable<Error> SendFile(beast::tcp_stream& stream, const RecordingsRouter::Download& download,
                                bool head_only) {
  beast::file_posix file;
  Error error;
  file.open(download.file.c_str(), beast::file_mode::scan, error);
  if (!error) file.seek(download.first, error);
  if (error) co_return error;

  http::response<http::empty_body> head(download.head.base());
  http::response_serializer<http::empty_body> serializer(head);
  stream.expires_after(kPieceTime);
  std::tie(error, std::ignore) = co_await http::async_write_header(stream, serializer, kAwait);
  std::string piece;
  for (std::uint64_t left = head_only ? 0 : download.length; left > 0 && !error;) {
    piece.resize(std::min(left, kPieceBytes));
    piece.resize(file.read(piece.data(), piece.size(), error));
    if (piece.empty() && !error) error = http::make_error_code(http::error::short_read);
    if (error) break;
    stream.expires_after(kPieceTime);
    std::tie(error, std::ignore) = co_await asio::async_write(stream, asio::buffer(piece), kAwait);
    left -= piece.size();
  }
  co_return error;
}

}  // namespace skein::bridge
