// FRTMock: inspection of a mock device, and injection of faults.

#include "MockShaderTable.h"

#include <algorithm>

namespace Lantern
{
namespace
{

template <class F>
std::vector<FRTMockCall> Filter(const FMockState& State, F Matches)
{
	std::lock_guard Lock(State.Mutex);
	std::vector<FRTMockCall> Found;
	std::copy_if(State.Calls.begin(), State.Calls.end(), std::back_inserter(Found), Matches);
	return Found;
}

template <class F>
std::vector<std::string> NamesOf(const FMockState& State, F Matches)
{
	std::lock_guard Lock(State.Mutex);
	std::vector<std::string> Names;
	for (const FRTMockCall& Call : State.Calls)
	{
		if (Matches(Call.Kind)) { Names.push_back(Call.Name); }
	}
	return Names;
}

} // namespace

std::vector<FRTMockCall> FRTMock::GetCalls() const
{
	return Filter(State, [](const FRTMockCall&) { return true; });
}

std::vector<FRTMockCall> FRTMock::FindCalls(ERTMockCall Kind) const
{
	return Filter(State, [=](const FRTMockCall& Call) { return Call.Kind == Kind; });
}

std::vector<FRTMockCall> FRTMock::FindCalls(ERTMockCall Kind, const std::string& Name) const
{
	return Filter(State, [&](const FRTMockCall& Call) { return Call.Kind == Kind && Call.Name == Name; });
}

std::vector<FRTMockCall> FRTMock::FindDispatches(const std::string& Pipeline) const { return FindCalls(ERTMockCall::Dispatch, Pipeline); }

uint32_t FRTMock::CountCalls(ERTMockCall Kind) const
{
	std::lock_guard Lock(State.Mutex);
	return static_cast<uint32_t>(
	    std::count_if(State.Calls.begin(), State.Calls.end(), [=](const FRTMockCall& Call) { return Call.Kind == Kind; }));
}

uint32_t FRTMock::CountCalls(ERTMockCall Kind, const std::string& Name) const
{
	return static_cast<uint32_t>(FindCalls(Kind, Name).size());
}

void FRTMock::ClearCalls()
{
	std::lock_guard Lock(State.Mutex);
	State.Calls.clear();
}

void FRTMock::SetCallRecording(bool bRecord) { State.bRecordCalls = bRecord; }

std::vector<std::string> FRTMock::GetCreatedBuffers() const
{
	return NamesOf(State, [](ERTMockCall Kind) { return Kind == ERTMockCall::CreateBuffer; });
}

std::vector<std::string> FRTMock::GetCreatedTextures() const
{
	return NamesOf(State, [](ERTMockCall Kind) { return Kind == ERTMockCall::CreateTexture; });
}

std::vector<std::string> FRTMock::GetCreatedPipelines() const
{
	return NamesOf(State, [](ERTMockCall Kind) {
		return Kind == ERTMockCall::CreateComputePipeline || Kind == ERTMockCall::CreateRasterPipeline ||
		       Kind == ERTMockCall::CreateRayTracingPipeline;
	});
}

uint32_t FRTMock::GetLiveObjectCount() const
{
	std::lock_guard Lock(State.Mutex);
	return static_cast<uint32_t>(State.Live.size());
}

std::vector<std::string> FRTMock::GetLiveObjects() const
{
	std::lock_guard Lock(State.Mutex);
	std::vector<std::string> Names;
	for (const FMockObject* Object : State.Live) { Names.push_back(std::string(Object->Type) + " " + Object->Name); }
	std::sort(Names.begin(), Names.end());
	return Names;
}

std::vector<std::string> FRTMock::GetErrors() const
{
	std::lock_guard Lock(State.Mutex);
	return State.Errors;
}

uint8_t* FRTMock::GetBytes(IRTBuffer* Buffer) const
{
	auto* Mine = dynamic_cast<FMockBuffer*>(Buffer);
	return Mine ? Mine->Bytes : nullptr;
}

std::vector<uint8_t> FRTMock::GetTexels(IRTTexture* Texture, uint32_t Mip, uint32_t Layer) const
{
	auto* Mine = dynamic_cast<FMockTexture*>(Texture);
	std::lock_guard Execute(State.ExecuteMutex);
	return Mine ? Mine->GetTexels(Mip, Layer) : std::vector<uint8_t>();
}

std::vector<IRTBuffer*> FRTMock::FindLiveBuffers(const std::string& Name) const
{
	std::lock_guard Lock(State.Mutex);
	std::vector<IRTBuffer*> Out;
	for (const auto& [Address, Buffer] : State.Buffers)
	{
		if (Buffer->Name == Name) { Out.push_back(Buffer); }
	}
	return Out;
}

namespace
{

template <class TInterface, class TObject>
std::vector<TInterface*> FindLive(FMockState& State)
{
	std::lock_guard Lock(State.Mutex);
	std::vector<TInterface*> Out;
	for (FMockObject* const Object : State.Live)
	{
		if (auto* const Mine = dynamic_cast<TObject*>(Object)) { Out.push_back(Mine); }
	}
	return Out;
}

} // namespace

std::vector<IRTScene*> FRTMock::FindLiveScenes() const { return FindLive<IRTScene, FMockScene>(State); }
std::vector<IRTShaderTable*> FRTMock::FindLiveTables() const { return FindLive<IRTShaderTable, FMockShaderTable>(State); }

IRTBuffer* FRTMock::FindBuffer(uint64_t DeviceAddress, uint64_t* OutOffset) const
{
	std::lock_guard Lock(State.Mutex);
	auto After = State.Buffers.upper_bound(DeviceAddress);
	if (After == State.Buffers.begin()) { return nullptr; }
	const auto& [Address, Buffer] = *std::prev(After);
	if (DeviceAddress - Address >= Buffer->Desc.Size) { return nullptr; }
	if (OutOffset) { *OutOffset = DeviceAddress - Address; }
	return Buffer;
}

FRTMockRecord FRTMock::ResolveRecord(IRTShaderTable* Table, ERTRecordKind Kind, uint32_t Index) const
{
	if (const auto* Mine = dynamic_cast<FMockShaderTable*>(Table)) { return Mine->Resolve(Kind, Index); }
	FRTMockRecord Record;
	Record.Error = "not a table of a mock device (wrapped?)";
	return Record;
}

FRTMockRecord FRTMock::ResolveHit(
    IRTShaderTable* Table, const FRTInstance& Instance, uint32_t GeometryIndex, uint32_t RayType, uint32_t RayMultiplier) const
{
	const uint32_t Offset = Instance.TableOffsetAndFlags & MaxInstanceIndex;
	return ResolveRecord(Table, ERTRecordKind::Hit, Offset + GeometryIndex * RayMultiplier + RayType);
}

std::vector<FRTMockInstance> FRTMock::GetSceneInstances(IRTScene* Scene) const
{
	std::vector<FRTMockInstance> Instances;
	const auto* Mine = dynamic_cast<FMockScene*>(Scene);
	if (!Mine) { return Instances; }
	std::lock_guard Lock(State.Mutex);
	for (size_t i = 0; i < Mine->Instances.size(); ++i)
	{
		const FRTInstance& Instance = Mine->Instances[i];
		FRTMockInstance& Item = Instances.emplace_back();
		Item.Instance = Instance;
		Item.bBuilt = Mine->bBuilt[i] != 0;
		const auto Found = State.Geometries.find(Instance.GeometryAddress);
		const auto Dead = State.DeadGeometries.find(Instance.GeometryAddress);
		Item.bDangling = Found == State.Geometries.end() && Instance.GeometryAddress != 0;
		Item.Geometry = Found == State.Geometries.end() ? nullptr : Found->second;
		Item.GeometryName = Found != State.Geometries.end() ? Found->second->Name : Dead != State.DeadGeometries.end() ? Dead->second : "?";
	}
	return Instances;
}

FRTMockGeometry FRTMock::GetGeometry(IRTGeometry* Geometry) const
{
	const auto* Mine = dynamic_cast<FMockGeometry*>(Geometry);
	std::lock_guard Lock(State.Mutex);
	return Mine ? Mine->Built : FRTMockGeometry();
}

FRTMockTable FRTMock::GetTable(IRTShaderTable* Table) const
{
	const auto* Mine = dynamic_cast<FMockShaderTable*>(Table);
	return Mine ? Mine->Inspect() : FRTMockTable();
}

FRTMockTraffic FRTMock::GetTraffic() const
{
	std::lock_guard Lock(State.Mutex);
	return State.Traffic;
}

void FRTMock::ClearTraffic()
{
	std::lock_guard Lock(State.Mutex);
	State.Traffic = {};
}

void FRTMock::SetManualFences(bool bManual)
{
	{
		std::lock_guard Lock(State.Mutex);
		State.bManual = bManual;
	}
	if (!bManual) { State.Complete(~0ull); }
}

void FRTMock::CompleteUpTo(FRTFence Fence) { State.Complete(GetFenceValue(Fence)); }

FRTFence FRTMock::GetLastFence() const
{
	std::lock_guard Lock(State.Mutex);
	return State.LastSubmitted;
}

uint32_t FRTMock::GetBlockingWaits() const
{
	std::lock_guard Lock(State.Mutex);
	return State.BlockingWaits;
}

void FRTMock::FailAllocation(uint32_t N)
{
	std::lock_guard Lock(State.Mutex);
	State.FailIn = N;
}

void FRTMock::FailEveryAllocation(uint32_t N)
{
	std::lock_guard Lock(State.Mutex);
	State.FailEvery = N;
	State.SinceFail = 0;
}

void FRTMock::SlowCompile(const std::string& Part, uint32_t Milliseconds)
{
	std::lock_guard Lock(State.Mutex);
	State.Slow.emplace_back(Part, Milliseconds);
}

void FRTMock::SlowFirstUse(uint32_t Milliseconds)
{
	const std::lock_guard Lock(State.ExecuteMutex);
	State.FirstUseNs = uint64_t(Milliseconds) * 1'000'000;
}

void FRTMock::HoldCompiles(const std::string& Part)
{
	std::lock_guard Lock(State.Mutex);
	State.Held.push_back(Part);
}

uint32_t FRTMock::GetCompilesInDriver() const
{
	std::lock_guard Lock(State.Mutex);
	return State.CompilesInDriver;
}

void FRTMock::FailCompile(const std::string& Part)
{
	std::lock_guard Lock(State.Mutex);
	State.Failing.push_back(Part);
}

void FRTMock::StarveCompiles(const std::string& Part)
{
	std::lock_guard Lock(State.Mutex);
	State.Starved.push_back(Part);
}

void FRTMock::ClearCompileFaults()
{
	{
		std::lock_guard Lock(State.Mutex);
		State.Slow.clear();
		State.Held.clear();
		State.Failing.clear();
		State.Starved.clear();
	}
	State.HoldEnded.notify_all();
}

void FRTMock::LoseDeviceAt(ERTMockCall Kind)
{
	std::lock_guard Lock(State.Mutex);
	State.LoseAt = Kind;
}

void FRTMock::LoseDevice()
{
	std::lock_guard Lock(State.Mutex);
	State.bLost = true;
}

} // namespace Lantern
