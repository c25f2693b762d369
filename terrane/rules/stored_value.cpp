#include "terrane/rules/stored_value.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "terrane/base/match.h"

namespace terrane::rules {
namespace {

void appendEscaped(std::string& text, char byte) {
    text += fmt::format("%{:02X}", static_cast<unsigned char>(byte));
}

bool isPlain(char byte) {
    return byte >= ' ' && byte <= '~' && byte != '%';
}

bool isOfKey(char byte) {
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || (byte >= '0' && byte <= '9') ||
           byte == '_' || byte == '-' || byte == '.';
}

class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {}

    bool isAtEnd() const { return text_.empty(); }

    std::optional<StoredValue> value(int depth) {
        if (text_.empty() || depth > kMaxStoredDepth) return std::nullopt;
        const char kind = text_.front();
        text_.remove_prefix(1);
        if (kind == 't' || kind == 'f') return StoredValue{kind == 't'};
        if (kind == 'i') return number<std::int64_t>();
        if (kind == 'd') return number<double>();
        if (kind == 's') return string();
        if (kind == '{') return table(depth);
        return std::nullopt;
    }

  private:
    template <class Number>
    std::optional<Number> plainNumber(char end) {
        Number number{};
        const auto [next, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
        const auto size = static_cast<std::size_t>(next - text_.data());
        if (error != std::errc() || size >= text_.size() || *next != end) return std::nullopt;
        text_.remove_prefix(size + 1);
        return number;
    }
    template <class Number>
    std::optional<StoredValue> number() {
        const auto read = plainNumber<Number>(';');
        if (!read || !std::isfinite(static_cast<double>(*read))) return std::nullopt;
        return StoredValue{*read};
    }
    std::optional<StoredValue> string() {
        const auto size = plainNumber<std::size_t>(':');
        if (!size || *size >= text_.size() || text_[*size] != ';') return std::nullopt;
        std::string bytes;
        for (std::size_t k = 0; k < *size; ++k) {
            if (isPlain(text_[k])) {
                bytes += text_[k];
                continue;
            }
            unsigned byte = 0;
            const char* digits = text_.data() + k + 1;
            if (text_[k] != '%' || k + 2 >= *size ||
                std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2)
                return std::nullopt;
            bytes += static_cast<char>(byte);
            k += 2;
        }
        text_.remove_prefix(*size + 1);
        return StoredValue{std::move(bytes)};
    }
    std::optional<StoredValue> table(int depth) {
        StoredValue::Table pairs;
        while (!text_.empty() && text_.front() != '}') {
            auto key = value(depth + 1);
            if (!key || std::holds_alternative<StoredValue::Table>(key->value)) return std::nullopt;
            auto held = value(depth + 1);
            if (!held) return std::nullopt;
            pairs.emplace_back(std::move(*key), std::move(*held));
        }
        if (text_.empty()) return std::nullopt;
        text_.remove_prefix(1);
        return StoredValue{std::move(pairs)};
    }

    std::string_view text_;
};

}  // namespace

void encodeStored(std::string& text, const StoredValue& value) {
    std::visit(base::Match{
                   [&](bool is) { text += is ? 't' : 'f'; },
                   [&](std::int64_t number) { text += fmt::format("i{};", number); },
                   [&](double number) { text += fmt::format("d{};", number); },
                   [&](const std::string& bytes) {
                       std::string escaped;
                       for (const char byte : bytes) {
                           if (isPlain(byte))
                               escaped += byte;
                           else
                               appendEscaped(escaped, byte);
                       }
                       text += fmt::format("s{}:{};", escaped.size(), escaped);
                   },
                   [&](const StoredValue::Table& table) {
                       text += '{';
                       for (const auto& [key, held] : table) {
                           encodeStored(text, key);
                           encodeStored(text, held);
                       }
                       text += '}';
                   },
               },
               value.value);
}

std::optional<StoredValue> decodeStored(std::string_view text) {
    if (text.size() > kMaxStoredBytes) return std::nullopt;
    Reader reader(text);
    auto value = reader.value(0);
    return value && reader.isAtEnd() ? std::move(value) : std::nullopt;
}

std::string escapedKey(std::string_view key) {
    std::string text;
    for (const char byte : key) {
        if (isOfKey(byte))
            text += byte;
        else
            appendEscaped(text, byte);
    }
    return text;
}

}  // namespace terrane::rules
