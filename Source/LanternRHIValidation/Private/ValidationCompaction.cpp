// FValidatedCommandList: compacted sizes and compacted copies of geometries.
#include "ValidationCommandList.h"

#include <algorithm>
#include <utility>

namespace Lantern
{
namespace
{

unsigned long long Wide(uint64_t Value) { return Value; }

bool HasSameShape(const FRTGeometrySection& A, const FRTGeometrySection& B)
{
	return A.VertexCount == B.VertexCount && A.TriangleCount == B.TriangleCount && A.bProcedural == B.bProcedural &&
	       A.bOpaque == B.bOpaque && A.IndexType == B.IndexType;
}

} // namespace

FValidatedQueryPool::FValidatedQueryPool(std::shared_ptr<FValidationState> InState, TRTRef<IRTQueryPool> InInner)
    : TValidated(std::move(InState), Print("query pool of %u", InInner->GetCount()), InInner),
      Track(std::make_shared<FQueryTrack>())
{
	Track->Label = Label;
	Track->Queries.resize(GetCount());
}

bool FValidatedQueryPool::GetResults(uint32_t First, uint32_t Count, uint64_t* OutValues)
{
	if (!IsInside(First, Count, GetCount()) || !OutValues)
	{
		State->Report(Print("GetResults: queries %u + %u of %u", First, Count, GetCount()));
		return false;
	}
	const bool bThere = Inner->GetResults(First, Count, OutValues);
	if (!bThere || GetKind() != ERTQuery::CompactedSize) { return bThere; }
	const FRTFence Completed = State->Inner->GetCompletedFence();
	std::lock_guard Lock(State->Mutex);
	for (uint32_t i = 0; i < Count; ++i)
	{
		const FQueryTrack::FQuery& Query = Track->Queries[First + i];
		// Until the submission that writes it has finished, the pool may still hold the size of another geometry.
		if (Query.Geometry && Query.Fence <= Completed) { Query.Geometry->CompactedSize = OutValues[i]; }
	}
	return true;
}

void FValidatedQueryPool::MarkReset(uint32_t First, uint32_t Count)
{
	std::lock_guard Lock(State->Mutex);
	for (uint32_t i = First; i < First + Count; ++i) { Track->Queries[i].bReset = true; }
}

void FValidatedCommandList::WriteCompactedSize(IRTQueryPool* Queries, uint32_t Index, IRTGeometry* Geometry)
{
	const char* Call = "WriteCompactedSize";
	if (!CanRecordOutside(Call)) { return; }
	auto* Pool = State->Require<FValidatedQueryPool>(Queries, Where(Call) + ": Queries");
	auto* Mine = State->Require<FValidatedGeometry>(Geometry, Where(Call) + ": Geometry");
	if (!Pool || !Mine) { return; }
	if (Pool->GetKind() != ERTQuery::CompactedSize)
	{
		return Report(Call, Mine->Label + ": " + Pool->Label + " is not for compacted sizes");
	}
	if (Index >= Pool->GetCount()) { return Report(Call, Mine->Label + Print(": query %u of %u", Index, Pool->GetCount())); }
	if (!Mine->Track->bAllowCompaction) { return Report(Call, Mine->Label + " was created without bAllowCompaction"); }
	if (bUnflushedBuild) { return Report(Call, Mine->Label + ": geometries were built, with no memory barrier from BuildWrite since"); }
	{
		std::lock_guard Lock(State->Mutex);
		if (!std::exchange(Pool->Track->Queries[Index].bReset, false))
		{
			return Report(Call, Mine->Label + Print(": query %u was not reset since it was written", Index));
		}
	}
	AddStep(EKind::RequireBuilt, Call).Geometry = Mine->Track;
	FValidationStep& Step = AddStep(EKind::WriteSize, Call);
	Step.Geometry = Mine->Track;
	Step.Queries = Pool->Track;
	Step.Count = Index;
	KeptGeometries.emplace_back(Mine->Track);
	Inner->WriteCompactedSize(Pool->Inner.Get(), Index, Mine->Inner.Get());
}

bool FValidatedCommandList::CheckCompaction(const FValidatedGeometry& Dest, const FValidatedGeometry& Source)
{
	const FGeometryTrack &To = *Dest.Track, &From = *Source.Track;
	std::string Wrong;
	uint64_t Size = 0;
	{
		std::lock_guard Lock(State->Mutex);
		Size = From.CompactedSize;
	}
	if (!From.bAllowCompaction) { Wrong = Source.Label + " was created without bAllowCompaction"; }
	else if (From.CompactedBytes) { Wrong = Source.Label + " is a compacted copy itself"; }
	else if (!To.CompactedBytes) { Wrong = Dest.Label + " was created without CompactedBytes"; }
	else if (Size == 0) { Wrong = "no compacted size of " + Source.Label + " has been read (WriteCompactedSize, then GetResults)"; }
	else if (To.CompactedBytes != Size)
	{
		Wrong = Dest.Label + Print(" was created for %llu bytes, but ", Wide(To.CompactedBytes)) + Source.Label +
		        Print(" needs %llu", Wide(Size));
	}
	else if (To.bAllowUpdate != From.bAllowUpdate || To.bFastBuild != From.bFastBuild ||
	         !std::equal(To.Sections.begin(), To.Sections.end(), From.Sections.begin(), From.Sections.end(), HasSameShape))
	{
		Wrong = Dest.Label + " was created with other sections or flags than " + Source.Label;
	}
	if (!Wrong.empty()) { Report("CompactGeometry", Wrong); }
	return Wrong.empty();
}

void FValidatedCommandList::CompactGeometry(IRTGeometry* Dest, IRTGeometry* Source)
{
	const char* Call = "CompactGeometry";
	if (!CanRecordOutside(Call)) { return; }
	auto* To = State->Require<FValidatedGeometry>(Dest, Where(Call) + ": Dest");
	auto* From = State->Require<FValidatedGeometry>(Source, Where(Call) + ": Source");
	if (!To || !From || !CheckCompaction(*To, *From)) { return; }
	if (bUnflushedBuild) { return Report(Call, From->Label + ": geometries were built, with no memory barrier from BuildWrite since"); }
	AddStep(EKind::RequireBuilt, Call).Geometry = From->Track;
	AddStep(EKind::BuildGeometry, Call).Geometry = To->Track;
	KeptGeometries.emplace_back(From->Track);
	KeptGeometries.emplace_back(To->Track);
	{
		std::lock_guard Lock(State->Mutex);
		To->Track->bBuildRecorded = true;
	}
	bUnflushedGeometry = true;
	Inner->CompactGeometry(To->Inner.Get(), From->Inner.Get());
}

} // namespace Lantern
