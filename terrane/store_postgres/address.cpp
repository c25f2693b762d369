#include "terrane/store_postgres/address.h"

#include <libpq-fe.h>

#include <algorithm>
#include <memory>

#include "terrane/base/text.h"

namespace terrane::store_postgres {
namespace {

constexpr std::string_view kSchemes[] = {"postgresql://", "postgres://"};
constexpr std::string_view kSchemaParameter = "schema=";
constexpr std::size_t kMaxSchemaBytes = 63;  // limit of names in PostgreSQL

struct FreeOptions {
    void operator()(PQconninfoOption* options) const { PQconninfoFree(options); }
};
using Options = std::unique_ptr<PQconninfoOption, FreeOptions>;

std::string valueOf(const Options& options, std::string_view keyword) {
    for (const PQconninfoOption* option = options.get(); option && option->keyword; ++option)
        if (option->keyword == keyword) return option->val ? option->val : "";
    return "";
}

std::string withoutPercents(std::string_view text) {
    std::string plain;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const bool mayBeCoded = text[at] == '%' && at + 2 < text.size();
        const auto byte = mayBeCoded ? base::hexByte(text[at + 1], text[at + 2]) : std::nullopt;
        plain += byte ? static_cast<char>(*byte) : text[at];
        if (byte) at += 2;
    }
    return plain;
}

// Whether a password has "/" or "@" without percent-encoding: libpq takes parts of it for host, port and
// database, which messages show.
bool isMisread(const Options& options, std::string_view url) {
    const auto has = [&](const char* keyword, char c, std::size_t from) {
        return valueOf(options, keyword).find(c, from) != std::string::npos;
    };
    if (valueOf(options, "port").find_first_not_of("0123456789,") != std::string::npos) return true;
    if (has("host", '@', 1)) return true;  // a leading @ is an abstract socket
    const std::size_t path = url.find('/', url.find("//") + 2);
    return path != std::string_view::npos && has("dbname", '@', 0) &&
           url.find('@', path) != std::string_view::npos;
}

// Removes the schema from the URL's parameters and returns it.
std::string takeSchema(std::string& url) {
    const std::size_t question = url.find('?');
    if (question == std::string::npos) return std::string(kDefaultSchema);
    std::string schema(kDefaultSchema), rest;
    std::size_t at = question + 1;
    while (at <= url.size()) {
        const std::size_t end = std::min(url.find('&', at), url.size());
        const std::string_view part = std::string_view(url).substr(at, end - at);
        if (part.starts_with(kSchemaParameter)) {
            schema = withoutPercents(part.substr(kSchemaParameter.size()));
        } else if (!part.empty()) {
            rest += (rest.empty() ? "?" : "&") + std::string(part);
        }
        at = end + 1;
    }
    url = url.substr(0, question) + rest;
    return schema;
}

// "postgresql://host:5432/name", a socket as "postgresql:///name".
std::string shownOf(const Options& options, const std::string& schema) {
    std::string host = valueOf(options, "host");
    if (host.empty()) host = valueOf(options, "hostaddr");
    const std::string port = valueOf(options, "port"), database = valueOf(options, "dbname");
    std::string shown = "postgresql://";
    if (!host.starts_with('/')) shown += host;
    if (!port.empty() && port != "5432") shown += ":" + port;
    shown += "/" + database;
    if (schema != kDefaultSchema) shown += "?" + std::string(kSchemaParameter) + schema;
    return shown;
}

}  // namespace

bool isPostgresUrl(std::string_view text) {
    return std::ranges::any_of(kSchemes, [&](std::string_view scheme) { return text.starts_with(scheme); });
}

base::Result<Address> addressOf(const std::string& url) {
    Address address{url, {}, {}};
    address.schema = takeSchema(address.url);
    // PostgreSQL replaces "$user" by the user's name, also in quotes.
    if (address.schema.empty() || address.schema.size() > kMaxSchemaBytes || address.schema == "$user" ||
        address.schema.find('\0') != std::string::npos)
        return base::fail(base::ErrorCode::BadInput, "postgresql://…: a schema has a name of 1 to {} bytes",
                          kMaxSchemaBytes);
    char* problem = nullptr;
    const Options given(PQconninfoParse(address.url.c_str(), &problem));
    PQfreemem(problem);  // contains the text, including the password
    if (!given || isMisread(given, address.url))
        return base::fail(base::ErrorCode::BadInput,
                          "postgresql://…: not a URL of a database: "
                          "postgresql://[user[:password]@][host][:port]/database[?schema=NAME], "
                          "with / as %2F and @ as %40 in a password");
    address.shown = base::printable(shownOf(given, address.schema));
    return address;
}

}  // namespace terrane::store_postgres
