// FValidationState: messages, and which objects live or have died.
#include "ValidationState.h"

#include "ValidationObjects.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "LanternRHI/RTText.h"

namespace Lantern
{

std::string Print(const char* Format, ...)
{
	char Buffer[480];
	va_list Arguments;
	va_start(Arguments, Format);
	std::vsnprintf(Buffer, sizeof(Buffer), Format, Arguments);
	va_end(Arguments);
	return Buffer;
}

std::string MakeLabel(const char* Type, const char* Name)
{
	return std::string(Type) + " '" + (Name && *Name ? FRTShown(Name).Text : "unnamed") + "'";
}

std::string DescribeAccess(ERTAccess Access)
{
	static constexpr const char* Names[] = {"ShaderRead", "StorageRead", "StorageWrite", "RenderTarget", "DepthWrite", "IndexRead",
	    "IndirectRead", "CopyRead", "CopyWrite", "GeometryInput", "BuildRead", "BuildWrite", "TraceRead", "HostRead", "External"};
	std::string Text;
	for (uint32_t Bit = 0; Bit < std::size(Names); ++Bit)
	{
		if (static_cast<uint32_t>(Access) & (1u << Bit)) { Text += (Text.empty() ? "" : "|") + std::string(Names[Bit]); }
	}
	return Text.empty() ? "None" : Text;
}

void FValidationState::Report(const std::string& Message)
{
	std::lock_guard Lock(CallbackMutex);
	if (Callback) { Callback(User, Message.c_str()); }
}

FRTStatus FValidationState::Fail(const std::string& Message)
{
	Report(Message);
	return FRTStatus::Error(ERTResult::InvalidArgument, "%s", Message.c_str());
}

void FValidationState::Add(const IRTRefCounted* Key, FValidated* Object)
{
	std::lock_guard Lock(Mutex);
	Live[Key] = Object;
	Dead.erase(Key);
}

void FValidationState::Remove(const IRTRefCounted* Key)
{
	std::lock_guard Lock(Mutex);
	Live.erase(Key);
	Dead.insert(Key);
}

FValidated* FValidationState::FindAny(const IRTRefCounted* Key)
{
	std::lock_guard Lock(Mutex);
	const auto Found = Live.find(Key);
	return Found == Live.end() ? nullptr : Found->second;
}

void FRecordTracks::Resize(uint32_t InCount)
{
	auto Grown = std::make_unique<std::atomic<uint32_t>[]>(InCount);
	for (uint32_t i = 0; i < std::min(Count, InCount); ++i) { Grown[i].store(Get(i), std::memory_order_relaxed); }
	Generations = std::move(Grown);
	Count = InCount;
}

void FValidationState::Bury(const std::shared_ptr<FGeometryTrack>& Geometry)
{
	constexpr size_t MaxDead = 1 << 17;
	std::lock_guard Lock(Mutex);
	Geometry->bDead = true;
	Geometry->Sections.clear();
	DeadGeometries.push_back(Geometry);
	if (DeadGeometries.size() <= MaxDead) { return; }
	const auto Found = Geometries.find(DeadGeometries.front()->Address);
	// The address may have been used again.
	if (Found != Geometries.end() && Found->second == DeadGeometries.front()) { Geometries.erase(Found); }
	DeadGeometries.pop_front();
}

bool FValidationState::IsDead(const void* Key)
{
	std::lock_guard Lock(Mutex);
	return Dead.contains(Key);
}

void FValidationState::ReportNotFound(const void* Object, const std::string& What)
{
	if (!Object) { Report(What + " is null"); }
	else if (IsDead(Object)) { Report(What + " has already been released"); }
	else { Report(What + " is not an object of this device"); }
}

} // namespace Lantern
