// What the validation wrapper's device and objects share: who lives, who died, what state each resource is in.
#pragma once

#include "LanternRHIValidation/ValidationDevice.h"

#include <array>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace Lantern
{

/// State of a buffer or texture as of the last submission.
struct FAccessState
{
	ERTAccess Access = ERTAccess::None;
	bool bKnown = true;     ///< false: an imported texture before its first barrier
	bool bImplicit = false; ///< from a use, not from a barrier
	bool bMerged = false;   ///< from a memory barrier: a resource barrier need not repeat all of it
};

struct FResourceTrack
{
	std::string Label;
	bool bTexture = false;
	ERTMemory Memory = ERTMemory::Device;
	FAccessState State;
};

struct FGeometryTrack
{
	std::string Label;
	uint64_t Address = 0;
	std::vector<FRTGeometrySection> Sections; ///< as created; pointers in it are never used
	bool bAllowUpdate = false;
	bool bBuilt = false;
	bool bDead = false;
};

/// What is known of a scene's instances; nothing where they were written by a shader.
struct FSceneContent
{
	bool bBuilt = false;
	bool bKnown = false;
	uint32_t HighestOffset = 0; ///< of the shader table, over instances with a mask
	uint32_t HighestInstance = 0;
	bool bAny = false;
};

struct FSceneTrack
{
	std::string Label;
	FSceneContent Content;
};

enum class ERecordState : uint8_t
{
	Never,
	Set,
	Updated
};

struct FTableTrack
{
	std::string Label;
	std::array<std::vector<ERecordState>, 4> Records; ///< by ERTRecordKind
	bool bUpdateRecorded = false;
	bool bUpdated = false; ///< an update has been submitted
};

class FValidated;

struct FValidationState
{
	FValidationState(IRTDevice* InInner, FRTValidationCallback InCallback, void* InUser)
	    : Inner(InInner),
	      Callback(InCallback),
	      User(InUser)
	{
	}

	TRTRef<IRTDevice> Inner;
	FRTValidationCallback Callback;
	void* User;

	std::mutex CallbackMutex;
	std::mutex SubmitMutex; ///< submissions are judged in the order in which they are made
	std::mutex Mutex;       ///< of everything below and of the tracks
	std::unordered_map<const IRTRefCounted*, FValidated*> Live;
	std::unordered_set<const void*> Dead; ///< released wrappers, until their address is used again
	std::unordered_map<uint64_t, std::shared_ptr<FGeometryTrack>> Geometries;
	std::vector<std::weak_ptr<FSceneTrack>> Scenes;
	std::vector<std::weak_ptr<FResourceTrack>> Buffers;
	FRTFence LastFence = 0;

	void Report(const std::string& Message);
	FRTStatus Fail(const std::string& Message);
	void Add(const IRTRefCounted* Key, FValidated* Object);
	void Remove(const IRTRefCounted* Key);
	FValidated* FindAny(const IRTRefCounted* Key);
	bool IsDead(const void* Key);
	/// The wrapper behind Object; null where Object is null, released, or not of this device.
	template <class W, class I>
	W* Find(I* Object)
	{
		return Object ? dynamic_cast<W*>(FindAny(Object)) : nullptr;
	}
	/// As Find; reports where there is none. What: the call and the argument.
	template <class W, class I>
	W* Require(I* Object, const std::string& What)
	{
		W* Found = Find<W>(Object);
		if (!Found)
		{
			ReportNotFound(Object, What);
		}
		return Found;
	}

private:
	void ReportNotFound(const void* Object, const std::string& What);
};

/// "ShaderRead|CopyRead"
std::string DescribeAccess(ERTAccess Access);
/// "buffer 'Name'"
std::string MakeLabel(const char* Type, const char* Name);
/// printf-style.
std::string Print(const char* Format, ...) __attribute__((format(printf, 1, 2)));
/// Offset + Size lies within Whole, without overflow.
constexpr bool IsInside(uint64_t Offset, uint64_t Size, uint64_t Whole)
{
	return Offset <= Whole && Size <= Whole - Offset;
}

} // namespace Lantern
