#include "bus/state_file.h"

#include <boost/crc.hpp>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <skein/event_t.hpp>
#include <utility>

#include "files/atomic_file.h"

namespace skein::bus {
namespace {

std::uint32_t Checksum(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

std::string Heading(const std::string& kind) { return "skein-state " + kind + "\n"; }

}  // namespace

StateFile::StateFile(std::filesystem::path file, std::string kind, Events& events)
    : file_(std::move(file)), kind_(std::move(kind)), events_(events) {
  if (kept()) thread_ = std::thread([this] { WriteAll(); });
}

StateFile::~StateFile() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::optional<std::string> StateFile::Read() {
  if (!kept() || !std::filesystem::exists(file_)) return std::nullopt;
  std::ifstream stream(file_, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::string heading = Heading(kind_);
  std::uint32_t checksum = 0;
  const std::size_t begin = heading.size() + sizeof checksum;
  if (!bytes.starts_with(heading) || bytes.size() < begin) {
    SetAside("it is not one of ours, or of another version");
    return std::nullopt;
  }
  std::memcpy(&checksum, bytes.data() + heading.size(), sizeof checksum);
  if (checksum != Checksum(std::string_view(bytes).substr(begin))) {
    SetAside("it is damaged");
    return std::nullopt;
  }
  bytes.erase(0, begin);
  return bytes;
}

void StateFile::SetAside(const std::string& why) {
  const std::string aside = file_.string() + ".damaged";
  std::error_code error;
  std::filesystem::rename(file_, aside, error);
  events_.Tell(event_t::CAUTION, "state_set_aside",
               "the saved state " + file_.string() + " is not used: " + why +
                   (error ? "; it cannot be renamed: " + error.message() : "; it is kept as " + aside));
}

void StateFile::Save(std::string state) {
  if (!kept()) return;
  std::string problem;
  {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(state);
    problem = problem_;
  }
  changed_.notify_all();
  TellProblem(problem);
}

void StateFile::SaveNow(std::string state) {
  if (!kept()) return;
  std::unique_lock lock(mutex_);
  waiting_ = std::move(state);
  changed_.notify_all();
  changed_.wait(lock, [this] { return !waiting_ && !writing_; });
  const std::string problem = problem_;
  lock.unlock();
  TellProblem(problem);
}

void StateFile::WriteAll() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return waiting_ || ends_; });
    if (!waiting_) return;
    const std::string state = *std::exchange(waiting_, std::nullopt);
    writing_ = true;
    lock.unlock();
    std::string bytes = Heading(kind_);
    const std::uint32_t checksum = Checksum(state);
    bytes.append(reinterpret_cast<const char*>(&checksum), sizeof checksum);
    bytes += state;
    std::string problem;
    try {
      files::WriteAtomically(file_, bytes);
    } catch (const std::exception& error) {
      problem = error.what();
    }
    lock.lock();
    problem_ = problem;
    writing_ = false;
    changed_.notify_all();
  }
}

void StateFile::TellProblem(const std::string& problem) {
  // The flight goes on without it; once is enough.
  if (!problem.empty() && !told_) events_.Tell(event_t::CAUTION, "state_not_saved", problem);
  told_ = !problem.empty();
}

}  // namespace skein::bus
