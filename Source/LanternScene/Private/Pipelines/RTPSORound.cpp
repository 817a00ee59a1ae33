// The queue of a round of compiles.
#include "Pipelines/RTPSORound.h"

#include <cassert>
#include <utility>

namespace Lantern
{

void FCompileRound::Add(const std::vector<FUnitStateRef>& Units, FTime InEnd)
{
	for (const FUnitStateRef& Unit : Units)
	{
		assert(Unit->Work == EUnitWork::Idle);
		Unit->Work = EUnitWork::Queued;
		Queue.push_back(Unit);
	}
	if (bOpen) { return; }
	bOpen = true;
	End = InEnd;
	Shared = std::make_shared<FSharedShaders>();
}

FUnitStateRef FCompileRound::TakeUnit()
{
	assert(HasUnit());
	FUnitStateRef Unit = std::move(Queue[Next++]);
	Unit->Work = EUnitWork::Compiling;
	++Running;
	return Unit;
}

void FCompileRound::EndUnit(FUnitState& Unit)
{
	assert(Running > 0 && Unit.Work == EUnitWork::Compiling);
	Unit.Work = EUnitWork::Idle;
	--Running;
}

void FCompileRound::Close(FTrash& Trash)
{
	for (; Next < Queue.size(); ++Next) { Queue[Next]->Work = EUnitWork::Idle; }
	Queue.clear();
	Next = 0;
	bOpen = false;
	Trash.Discard(std::exchange(Shared, nullptr));
}

} // namespace Lantern
