#include "cli/log/message_table.h"

#include <spdlog/fmt/fmt.h>

#include <concepts>
#include <cstdint>
#include <map>
#include <skein/fields.hpp>
#include <type_traits>

#include "bus/decode.h"
#include "recording/message_types.h"

namespace skein::cli {
namespace {

template <typename T>
concept Scalar = std::is_arithmetic_v<T> || std::same_as<T, std::string>;

template <typename T>
struct IsVector : std::false_type {};
template <typename T>
struct IsVector<std::vector<T>> : std::true_type {};

std::string CellOf(const std::string& text) { return text; }
std::string CellOf(bool value) { return value ? "1" : "0"; }
/// The shortest text that is read back as the same number.
std::string CellOf(double value) { return fmt::format("{}", value); }
std::string CellOf(std::integral auto value) { return std::to_string(value); }

/// Fills the row of one struct, and the names of its columns where they are wanted; what is a list of structs
/// is left to CollectLists.
class RowOf {
 public:
  explicit RowOf(std::vector<std::string>& row, std::vector<std::string>* columns = nullptr)
      : row_(row), columns_(columns) {}

  template <typename Message>
  void Add(const Message& message, const std::string& prefix) {
    VisitFields(message, [&](const char* name, const auto& value) { AddField(value, prefix, name); });
  }

 private:
  template <typename T>
  void AddField(const T& value, const std::string& prefix, const char* name) {
    if constexpr (Scalar<T>) {
      AddCell(CellOf(value), prefix, name);
    } else if constexpr (!IsVector<T>::value) {
      Add(value, prefix + name + '.');
    } else if constexpr (Scalar<typename T::value_type>) {
      std::string cell;
      for (const auto& item : value) cell += (cell.empty() ? "" : " ") + CellOf(item);
      AddCell(std::move(cell), prefix, name);
    }
  }

  void AddCell(std::string cell, const std::string& prefix, const char* name) {
    if (columns_) columns_->push_back(prefix + name);
    row_.push_back(std::move(cell));
  }

  std::vector<std::string>& row_;
  std::vector<std::string>* columns_;
};

/// The lists of structs in a message, each with the rows of its items.
struct List {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

template <typename Message>
void CollectLists(const Message& message, const std::string& prefix, std::vector<List>& lists) {
  VisitFields(message, [&]<typename T>(const char* name, const T& value) {
    if constexpr (IsVector<T>::value) {
      using Item = typename T::value_type;
      if constexpr (!Scalar<Item>) {
        List& list = lists.emplace_back();
        std::vector<std::string> unused;
        RowOf(unused, &list.columns).Add(Item(), prefix + name + '.');
        for (const Item& item : value) RowOf(list.rows.emplace_back()).Add(item, "");
      }
    } else if constexpr (!Scalar<T>) {
      CollectLists(value, prefix + name + '.', lists);
    }
  });
}

template <typename Message>
void Fill(MessageTable& table, std::span<const std::byte> data) {
  const auto message = bus::Decode<Message>(data.data(), data.size());
  if (!message) return;
  std::vector<std::string> common;
  RowOf(common, &table.columns).Add(*message, "");
  std::vector<List> lists;
  CollectLists(*message, "", lists);
  std::size_t width = common.size();
  for (const List& list : lists) {
    table.columns.insert(table.columns.end(), list.columns.begin(), list.columns.end());
    width += list.columns.size();
  }
  std::size_t column = common.size();
  for (List& list : lists) {
    for (auto& cells : list.rows) {
      auto& row = table.rows.emplace_back(common);
      row.resize(width);
      std::move(cells.begin(), cells.end(), row.begin() + static_cast<std::ptrdiff_t>(column));
    }
    column += list.columns.size();
  }
  if (table.rows.empty()) table.rows.emplace_back(common).resize(width);
}

using FillFunction = void (*)(MessageTable& table, std::span<const std::byte> data);

std::map<std::string_view, FillFunction> AllFillFunctions() {
  std::map<std::string_view, FillFunction> functions;
  ForEachMessageType([&]<typename Message>() { functions[Message::getTypeName()] = &Fill<Message>; });
  return functions;
}

}  // namespace

std::optional<MessageTable> ToTable(std::span<const std::byte> data) {
  static const auto fill_functions = AllFillFunctions();
  const recording::MessageType* type = recording::TypeOf(data);
  if (!type || !type->is_good(data)) return std::nullopt;
  MessageTable table;
  table.type = type->name;
  fill_functions.at(type->name)(table, data);
  return table;
}

}  // namespace skein::cli
