#include "recorder/recording.h"

#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "recording/card.h"

namespace skein::recorder {
namespace {

namespace fs = std::filesystem;

// Sync word, number, time and lengths of an event, and the first letters of its channel.
constexpr std::size_t kBeginBytes = 32;
constexpr std::size_t kLongestStem = 80;

[[noreturn]] void Throw(const fs::path& path, const char* what) {
  throw std::system_error(errno, std::generic_category(), path.string() + ": " + what);
}

std::string LocalTime(bus::Utime utime) {
  const std::time_t seconds = utime / bus::kSecond;
  std::tm local{};
  localtime_r(&seconds, &local);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y%m%d-%H%M%S", &local);
  return text.data();
}

bool Exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(path, ignored));
}

}  // namespace

std::string PartName(const std::string& recording, int part) {
  return part == 0 ? recording : fmt::format("{}.{:02}", recording, part);
}

std::string FileStem(const std::string& scenario) {
  std::string stem;
  for (const char letter : scenario) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte < 0x80 && std::isalnum(byte)) {
      stem += static_cast<char>(std::tolower(byte));
    } else if (!stem.empty() && stem.back() != '-') {
      stem += letter == '_' ? '_' : '-';
    }
    if (stem.size() >= kLongestStem) break;
  }
  while (!stem.empty() && (stem.back() == '-' || stem.back() == '_')) stem.pop_back();
  return stem.empty() ? "flight" : stem;
}

std::string BeginOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, kBeginBytes> bytes{};
  if (!stream.read(bytes.data(), bytes.size())) return "";
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return text;
}

Recording::Recording(fs::path folder, const std::string& stem, Card card, fs::path link)
    : folder_(std::move(folder)), stem_(stem), card_(std::move(card)), link_(std::move(link)) {
  fs::create_directories(folder_);
  Claim();
}

Recording::~Recording() { close(card_fd_); }

void Recording::Claim() {
  for (bus::Utime start = card_.start_utime;; start += bus::kSecond) {
    const std::string name = stem_ + "-" + LocalTime(start) + ".lcm";
    // Also when only a log lies there: it is somebody else's.
    if (Exists(folder_ / name)) continue;
    const int fd =
        open(recording::CardOf(folder_ / name).c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (fd < 0 && errno == EEXIST) continue;
    if (fd < 0) Throw(folder_, "cannot be written into");
    if (card_fd_ >= 0) close(card_fd_);
    card_fd_ = fd;
    flock(fd, LOCK_EX | LOCK_NB);
    name_ = name;
    return;
  }
}

void Recording::Point() const {
  const fs::path fresh = link_.string() + ".new";
  std::error_code ignored;
  fs::remove(fresh, ignored);
  fs::create_symlink(fs::absolute(folder_ / part()), fresh);
  fs::rename(fresh, link_);
}

void Recording::NextPart() {
  fs::create_directories(folder_);
  if (parts_ > 0 && part_bytes_ == 0 && !on_card_) {
    Point();
    return;
  }
  bytes_before_ += std::exchange(part_bytes_, 0);
  on_card_ = false;
  do {
    ++parts_;
  } while (Exists(folder_ / part()));
  Point();
}

void Recording::Look() {
  if (parts_ == 0) return;
  std::error_code missing;
  const auto size = fs::file_size(folder_ / part(), missing);
  part_bytes_ = missing ? 0 : static_cast<std::int64_t>(size);
  if (on_card_ || part_bytes_ == 0) return;
  const std::string begins = BeginOf(folder_ / part());
  if (begins.empty()) return;
  card_.parts.push_back({part(), begins});
  try {
    WriteCard();
    on_card_ = true;
  } catch (const std::system_error& error) {
    // The disk may be full; what is on no card is not removed, and it is tried again with the next look.
    card_.parts.pop_back();
    spdlog::debug("{}", error.what());
  }
}

void Recording::WriteCard() {
  nlohmann::ordered_json json = {{"written_by", "flight-recorder " SKEIN_VERSION},
                                 {"scenario", card_.scenario},
                                 {"start_utime", card_.start_utime},
                                 {"lcm_url", card_.lcm_url},
                                 {"parts", nlohmann::ordered_json::array()}};
  for (const Card::Part& part : card_.parts) {
    json["parts"].push_back({{"file", part.file}, {"begins", part.begins}});
  }
  const std::string text = json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  const fs::path fresh = folder_ / ("." + name_ + ".json.new");
  const int fd = open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) Throw(fresh, "cannot be written");
  // Locked before it has its name, so that there is no moment without.
  flock(fd, LOCK_EX | LOCK_NB);
  const bool written = write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (!written || rename(fresh.c_str(), recording::CardOf(folder_ / name_).c_str()) != 0) {
    const int reason = errno;
    close(fd);
    unlink(fresh.c_str());
    errno = reason;
    Throw(fresh, "cannot be written");
  }
  close(std::exchange(card_fd_, fd));
}

void Recording::Rename(const std::string& stem, const std::string& scenario) {
  const std::string before = name_;
  const std::string stem_before = std::exchange(stem_, stem);
  // The old card keeps its lock until nothing stands on it any more: nobody may take the parts for old ones
  // meanwhile.
  int old_card_fd = -1;
  if (stem != stem_before) {
    old_card_fd = std::exchange(card_fd_, -1);
    Claim();
    for (int part = 0; part < parts_; ++part) {
      std::error_code missing;  // a part that a person has removed
      fs::rename(folder_ / PartName(before, part), folder_ / PartName(name_, part), missing);
    }
    for (Card::Part& part : card_.parts) part.file.replace(0, before.size(), name_);
    if (parts_ > 0) Point();
  }
  card_.scenario = scenario;
  WriteCard();
  if (stem != stem_before) {
    fs::remove(recording::CardOf(folder_ / before));
    close(old_card_fd);
  }
}

}  // namespace skein::recorder
