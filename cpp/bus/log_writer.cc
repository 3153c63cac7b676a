#include "bus/log_writer.h"

#include <cstdio>
#include <stdexcept>
#include <utility>

namespace skein::bus {

LogWriter::LogWriter(std::shared_ptr<lcm::LCM> transport, const Executor& executor,
                     const std::filesystem::path& file)
    : transport_(std::move(transport)), executor_(executor), file_(file), log_(file.string(), "w") {
  if (!log_.good()) throw std::runtime_error(file.string() + ": cannot be written");
  subscription_ = transport_->subscribe(".*", &LogWriter::OnMessage, this);
  subscription_->setQueueCapacity(1'000'000);
}

LogWriter::~LogWriter() { transport_->unsubscribe(subscription_); }

void LogWriter::OnMessage(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
  lcm::LogEvent event{};
  event.timestamp = executor_.Now();
  event.channel = channel;
  event.datalen = static_cast<std::int32_t>(buffer->data_size);
  event.data = buffer->data;
  failed_ = log_.writeEvent(&event) != 0 || failed_;
}

void LogWriter::Flush() {
  failed_ = std::fflush(log_.getFilePtr()) != 0 || failed_;
  if (failed_) throw std::runtime_error(file_.string() + ": could not be written wholly");
}

}  // namespace skein::bus
