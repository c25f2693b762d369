#include "terrane/base/result.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "terrane/base/match.h"

namespace terrane::base {
namespace {

Result<int> half(int n) {
    if (n % 2 == 0) return n / 2;
    return fail(ErrorCode::BadInput, "{}: odd", n);
}

// An error converts unchanged to results of another type.
Result<std::string> quarter(int n) {
    const auto first = half(n);
    if (!first) return tl::unexpected(first.error());
    const auto second = half(*first);
    if (!second) return tl::unexpected(second.error());
    return std::to_string(*second);
}

TEST(Result, ValuesAndErrors) {
    EXPECT_EQ(*quarter(8), "2");
    const auto odd = quarter(6);
    ASSERT_FALSE(odd);
    EXPECT_EQ(odd.error().code, ErrorCode::BadInput);
    EXPECT_EQ(odd.error().message, "3: odd");
}

TEST(Result, WithoutACodeItIsAFailure) {
    const Result<void> failed = fail("{}: cannot be read", "a");
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().code, ErrorCode::Failed);
    EXPECT_TRUE(Result<void>());
}

// A result converts to bool: a copy of a Result<bool> must not use that.
TEST(Result, CopiesAreCopies) {
    Result<bool> no = false;
    const Result<bool> copy(no);
    ASSERT_TRUE(copy);
    EXPECT_FALSE(*copy);
    Result<std::optional<int>> none = std::nullopt;
    const Result<std::optional<int>> moved(std::move(none));
    ASSERT_TRUE(moved);
    EXPECT_EQ(*moved, std::nullopt);
    Result<std::unique_ptr<int>> owner = std::make_unique<int>(3);
    EXPECT_EQ(**owner, 3);
}

Result<std::unique_ptr<int>> halfOf(int number) {
    if (number % 2 != 0) return fail(ErrorCode::BadInput, "{} is odd", number);
    return std::make_unique<int>(number / 2);
}

Result<int> quarterOf(int number) {
    const auto half = TERRANE_TRY(halfOf(number));
    const auto quarter = TERRANE_TRY(halfOf(*half));
    return *quarter;
}

Result<void> checkQuarter(int number) {
    (void)TERRANE_TRY(quarterOf(number));
    return {};
}

Result<std::string> textOfQuarter(int number) {
    TERRANE_TRY(checkQuarter(number));
    return std::string("good");
}

TEST(Try, GivesTheValueOrReturnsTheError) {
    EXPECT_EQ(quarterOf(12).value(), 3);
    EXPECT_EQ(textOfQuarter(12).value(), "good");
    for (const int odd : {5, 6}) {
        const auto failed = textOfQuarter(odd);
        ASSERT_FALSE(failed);
        EXPECT_EQ(failed.error().code, ErrorCode::BadInput);
        EXPECT_EQ(failed.error().message, odd == 5 ? "5 is odd" : "3 is odd");
    }
}

TEST(Match, CallsTheFunctionOfTheAlternative) {
    struct Closed {};
    using Event = std::variant<int, std::string, Closed>;
    const auto said = [](const Event& event) {
        return std::visit(Match{[](int number) { return std::to_string(number); },
                                [](const OneOf<std::string, Closed> auto&) { return std::string("other"); }},
                          event);
    };
    EXPECT_EQ(said(7), "7");
    EXPECT_EQ(said("a"), "other");
    EXPECT_EQ(said(Closed()), "other");
}

}  // namespace
}  // namespace terrane::base
