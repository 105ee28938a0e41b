// Returns early from a function that returns a Result if a call in it has failed. Internal to the library: no
// installed header includes this one.
#pragma once

#include <utility>

#include "planet/base/result.h"

// TRY(call): returns the Error of a call that returns a Result<void>.
#define TRY(...) \
    if (auto tried = (__VA_ARGS__); !tried) return tl::unexpected(std::move(tried).error())

// TRY_ASSIGN(const auto info, call): returns the Error of the call, or defines `info` as its value.
#define TRY_ASSIGN(declaration, ...) TRY_ASSIGN_AS(TRY_NAME(tried, __LINE__), declaration, __VA_ARGS__)
#define TRY_ASSIGN_AS(result, declaration, ...)                      \
    auto result = (__VA_ARGS__);                                     \
    if (!(result)) return tl::unexpected(std::move(result).error()); \
    declaration = *std::move(result) /* NOLINT(bugprone-macro-parentheses) */
#define TRY_NAME(name, line) TRY_JOIN(name, line)
#define TRY_JOIN(name, line) name##line
