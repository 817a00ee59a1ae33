// A JSON value that knows its place in the document, so that every complaint can name it: "meshes[3].primitives[0]".
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>

namespace Lantern::Gltf
{

/// Says what is wrong and where, without the file's name. Quotes from the file are escaped. It is thrown inside the loader only; LoadScene
/// turns it into text.
class FError : public std::runtime_error
{
public:
	using std::runtime_error::runtime_error;
};

/// Refers to a value, and to its parent for the path: the parent must live as long.
class FJson
{
public:
	FJson() = default;
	explicit FJson(const nlohmann::json& Root) : Value(&Root) {}

	bool Exists() const { return Value != nullptr; }
	[[noreturn]] void Fail(std::string_view Message) const;
	std::string GetPath() const;

	/// Absent members are values that do not Exist(). It is an error if the value is no object or no array.
	FJson Member(const char* Key) const&;
	FJson Extension(const char* Name) const&;
	/// A member of "extras", which may be anything.
	FJson Extra(const char* Name) const&;
	size_t Count() const; ///< 0 if absent
	FJson Element(size_t Index) const&;
	FJson Member(const char* Key) const&& = delete; // the parent would be gone
	FJson Extension(const char* Name) const&& = delete;
	FJson Extra(const char* Name) const&& = delete;
	FJson Element(size_t Index) const&& = delete;
	std::string Dump() const; ///< text that is equal for equal values

	/// The value itself, which must exist and have the type.
	uint64_t ToUInt(uint64_t Max) const;
	double ToNumber() const; ///< finite
	float ToFloat() const;   ///< finite as a float
	const std::string& ToString() const;
	void RequireObject() const;

	/// Members with defaults.
	uint64_t GetUInt(const char* Key, uint64_t Default, uint64_t Max = UINT64_MAX) const;
	int32_t GetIndex(const char* Key, size_t Size, const char* What) const; ///< −1 if absent; < Size
	int32_t RequireIndex(const char* Key, size_t Size, const char* What) const;
	float GetFloat(const char* Key, float Default) const;
	bool GetBool(const char* Key, bool Default) const;
	std::string GetString(const char* Key, const char* Default) const;
	/// Reads an array of exactly Size numbers. If absent, it returns false and Out stays as it was.
	bool GetNumbers(const char* Key, size_t Size, double* Out) const;
	glm::vec2 GetVec2(const char* Key, const glm::vec2& Default) const;
	glm::vec3 GetVec3(const char* Key, const glm::vec3& Default) const;
	glm::vec4 GetVec4(const char* Key, const glm::vec4& Default) const;

private:
	FJson(const nlohmann::json* InValue, const FJson* InParent, const char* InKey, size_t InIndex)
	    : Value(InValue),
	      Parent(InParent),
	      Key(InKey),
	      Index(InIndex)
	{}
	void AppendPath(std::string& Out) const;

	const nlohmann::json* Value = nullptr;
	const FJson* Parent = nullptr;
	const char* Key = nullptr; ///< null: an element
	size_t Index = 0;
};

/// Parses text that may not nest deeper than any glTF does. Throws FError.
nlohmann::json ParseJson(std::string_view Text);

} // namespace Lantern::Gltf
