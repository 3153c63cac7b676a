#include "cli/spy.h"

#include <spdlog/fmt/fmt.h>

#include <deque>
#include <limits>
#include <nlohmann/json.hpp>

#include "bus/channel_ear.h"
#include "bus/conversions.h"
#include "cli/any_message.h"
#include "cli/log/text.h"
#include "cli/terminal.h"
#include "cli/traffic.h"

namespace skein::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr bus::Utime kTablePeriod = bus::kSecond;
constexpr bus::Utime kMessagePeriod = bus::kSecond / 5;
constexpr std::size_t kMostWaiting = 10'000;

/// A message of a channel is wanted when a field of it has a value.
class Filter {
 public:
  explicit Filter(const std::string& where) {
    if (where.empty()) return;
    const std::size_t equals = where.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Failure("--where: must be FIELD=VALUE, such as formation_id=2, is " + where);
    }
    field_ = where.substr(0, equals);
    value_ = where.substr(equals + 1);
  }

  bool Wants(const Json& fields) const {
    if (field_.empty()) return !fields.contains("chunk") || fields["chunk"] == 0;
    const auto field = fields.find(field_);
    if (field == fields.end()) return false;
    return (field->is_string() ? field->get<std::string>() : field->dump()) == value_;
  }

 private:
  std::string field_;
  std::string value_;
};

/// Writes a screen anew on a terminal; elsewhere one text after the other, with an empty line between.
class Screen {
 public:
  Screen(std::ostream& out, bool live) : out_(out), live_(live) {}

  void Show(const std::string& text) {
    const TerminalSize terminal = Terminal();
    const bool redraws = live_ && terminal.columns > 0;
    if (redraws) out_ << kClearScreen << Fitted(text, terminal);
    if (!redraws) out_ << (shown_ ? "\n" : "") << text;
    out_.flush();
    shown_ = true;
  }

 private:
  std::ostream& out_;
  bool live_;
  bool shown_ = false;
};

std::string Names(const Traffic& traffic) {
  std::string names;
  for (const auto& [name, unused] : traffic.channels())
    names += (names.empty() ? "" : ", ") + Printable(name);
  return names;
}

void ThrowIfSilent(const Traffic& traffic, bus::Utime now) {
  if (!traffic.channels().empty()) return;
  throw Failure(fmt::format("nothing was heard for {:.1f} s: is anything running, and on this LCM URL?",
                            bus::ToSeconds(now - traffic.start())));
}

/// Until when to listen.
bus::Utime End(const SpyOptions& options, bus::Utime now) {
  if (options.for_s > 0) return now + bus::ToUtime(options.for_s);
  return options.once ? now + kLongestPeriod : std::numeric_limits<bus::Utime>::max();
}

void SpyAll(Station& station, const SpyOptions& options, std::ostream& out) {
  bus::Executor& executor = station.bus().executor();
  Traffic traffic(executor.Now());
  const bus::ChannelEar ear(station.bus().transport(),
                            [&](const std::string& channel, const void* data, std::size_t size) {
                              traffic.Hear(executor.Now(), channel, data, size);
                            });
  const bus::Utime end = End(options, executor.Now());
  Screen screen(out, !options.once);
  const auto show = [&] {
    if (options.json) {
      out << TrafficJson(traffic, executor.Now()).dump(-1, ' ', false, Json::error_handler_t::replace)
          << '\n';
      out.flush();
    } else {
      screen.Show(TrafficTable(traffic, executor.Now(), Terminal().columns));
    }
  };
  try {
    while (executor.Now() < end) {
      const bus::Utime period = options.once ? end - executor.Now() : kTablePeriod;
      station.WaitUntil([] { return false; }, std::min(period, end - executor.Now()));
      if (!options.once) show();
    }
  } catch (const Interrupted&) {  // the way to end it
    if (!options.once) return;
  }
  ThrowIfSilent(traffic, executor.Now());
  if (options.once) show();
}

void SpyChannel(Station& station, const SpyOptions& options, std::ostream& out) {
  bus::Executor& executor = station.bus().executor();
  const Filter filter(options.where);
  Traffic traffic(executor.Now());
  std::deque<Json> waiting;  // fields of messages that are still to be shown; for people just the last one
  std::int64_t shown = 0;
  const bus::ChannelEar ear(station.bus().transport(),
                            [&](const std::string& channel, const void* data, std::size_t size) {
                              traffic.Hear(executor.Now(), channel, data, size);
                              if (channel != options.channel) return;
                              auto read = ReadFields(data, size);
                              if (!read || !filter.Wants(*read)) return;
                              if (!waiting.empty() && (!options.json || waiting.size() >= kMostWaiting))
                                waiting.pop_front();
                              waiting.push_back(*std::move(read));
                            });
  const bus::Utime end = End(options, executor.Now());
  Screen screen(out, !options.once);
  const auto show = [&](const Json& fields) {
    ++shown;
    const ChannelTraffic& channel = traffic.channels().at(options.channel);
    if (options.json) {
      const Json message = {{"channel", options.channel}, {"type", channel.type}, {"fields", fields}};
      out << message.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
      out.flush();
    } else {
      const auto rate = traffic.RateOf(channel, executor.Now());
      const std::string rates =
          rate ? fmt::format("{:.1f} Hz  {:.1f} kB/s  ", rate->messages_s, rate->bytes_s / 1e3) : "";
      screen.Show(fmt::format("{}  {}  {}{} heard{}\n", options.channel, channel.type, rates, channel.count,
                              channel.undecodable > 0 ? fmt::format(", {} bad", channel.undecodable) : "") +
                  MessageText(fields, Terminal().columns));
    }
  };
  bus::Utime next = executor.Now();
  try {
    while (executor.Now() < end && !(options.once && shown > 0)) {
      const auto due = [&] { return !waiting.empty() && executor.Now() >= next; };
      if (!station.WaitUntil(due, std::min(end - executor.Now(), kLongestPeriod))) continue;
      for (; !waiting.empty() && !(options.once && shown > 0); waiting.pop_front()) show(waiting.front());
      next = executor.Now() + (options.json ? 0 : kMessagePeriod);
    }
  } catch (const Interrupted&) {  // the way to end it
    return;
  }
  if (shown > 0) return;
  ThrowIfSilent(traffic, executor.Now());
  const auto heard = traffic.channels().find(options.channel);
  if (heard == traffic.channels().end())
    throw Failure(fmt::format("{} was not heard; there are {}", options.channel, Names(traffic)));
  if (heard->second.type.empty())
    throw Failure(options.channel + " carries no type of Skein: its fields are not known");
  throw Failure(
      fmt::format("none of the {} messages on {} could be shown{}", heard->second.count, options.channel,
                  options.where.empty() ? "" : ": no field has the value of --where " + options.where));
}

}  // namespace

void Spy(Station& station, const SpyOptions& options, std::ostream& out) {
  options.channel.empty() ? SpyAll(station, options, out) : SpyChannel(station, options, out);
}

}  // namespace skein::cli
