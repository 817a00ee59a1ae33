// Content hashes. Equal content has an equal hash on every machine of one byte order. The hash is XXH3 with 128 bits (Collet
// 2019). Accidental collisions do not occur in practice; it does not protect against intended ones.
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

/// Hashes values in the order of the calls. Not for structs with padding, whose bytes are undefined.
class FContentHasher
{
public:
	FContentHasher();
	~FContentHasher();
	void AddBytes(const void* Data, size_t Size);
	/// Adds the length, then the text, so that text and later values cannot be confused.
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

/// Hashes everything that a picture can depend on, which excludes names of nodes, warnings and the like. The texels must still
/// be there; FHostScene::GetContentHash returns the hash at load.
FContentHash HashScene(const FSceneDescription& Scene);

} // namespace Lantern
