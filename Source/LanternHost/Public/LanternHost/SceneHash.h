// Names content: what is equal has an equal hash, on every machine of the same byte order, and what differs has another.
// XXH3 with 128 bits (Collet 2019): no protection against intent, but no accident will ever hit twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include "LanternHost/SceneDescription.h"

namespace Lantern
{

struct FContentHash
{
	uint64_t Low = 0, High = 0;
	std::string ToHex() const; ///< 32 digits
	friend bool operator==(const FContentHash&, const FContentHash&) = default;
};

/// Hashes values in the order in which they come. Not for structs with padding, whose bytes nobody sets.
class FContentHasher
{
public:
	FContentHasher();
	~FContentHasher();
	void AddBytes(const void* Data, size_t Size);
	/// With its length before it, so that what follows cannot flow into it.
	void AddText(std::string_view Text);
	template <class T>
	void Add(const T& Value)
	{
		static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
		AddBytes(&Value, sizeof(Value));
	}
	FContentHash Finish() const;

private:
	struct FState;
	std::unique_ptr<FState> State;
};

/// Of everything in it that a picture can depend on: names of nodes, warnings and the like are left out. Texels must still be
/// there; FHostScene::GetContentHash has what they were at load.
FContentHash HashScene(const FSceneDescription& Scene);

} // namespace Lantern
