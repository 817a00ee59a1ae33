// Steps of a walk: drawn, left out, and said.
#include <algorithm>
#include <iterator>
#include <random>

#include "TableWalk.h"

namespace Lantern
{

std::vector<FWalkStep> MakeWalk(uint32_t Seed, uint32_t Count)
{
	// Per cent, in the order of EWalkStep; what is left is a frame.
	constexpr uint32_t Weights[] = {0, 20, 13, 3, 9, 8, 3, 1, 4, 2, 2, 1, 2, 1, 1, 1, 0};
	static_assert(std::size(Weights) == static_cast<size_t>(EWalkStep::Count));
	std::mt19937 Random(Seed);
	std::vector<FWalkStep> Steps(Count);
	for (FWalkStep& Step : Steps)
	{
		uint32_t Left = Random() % 100;
		for (uint32_t Kind = 1; Kind < std::size(Weights); ++Kind)
		{
			if (Left < Weights[Kind])
			{
				Step.Kind = static_cast<EWalkStep>(Kind);
				break;
			}
			Left -= Weights[Kind];
		}
		Step.A = static_cast<uint32_t>(Random());
		Step.B = static_cast<uint32_t>(Random());
		Step.C = static_cast<uint32_t>(Random());
	}
	return Steps;
}

std::vector<FWalkStep> ShrinkWalk(const FWalkSettings& Settings, std::vector<FWalkStep> Steps)
{
	// Needs no limit: there are about two runs for each step, whatever can be left out.
	for (size_t Chunk = std::max<size_t>(1, Steps.size() / 2); Chunk > 0; Chunk /= 2)
	{
		for (size_t First = 0; First < Steps.size();)
		{
			std::vector<FWalkStep> Fewer = Steps;
			Fewer.erase(Fewer.begin() + static_cast<ptrdiff_t>(First),
			    Fewer.begin() + static_cast<ptrdiff_t>(std::min(First + Chunk, Steps.size())));
			if (RunWalk(Settings, Fewer).Failure.empty()) { First += Chunk; }
			else { Steps = std::move(Fewer); }
		}
	}
	return Steps;
}

std::string ToString(const std::vector<FWalkStep>& Steps)
{
	constexpr const char* Names[] = {"Frame", "AddObject", "RemoveObject", "MoveObject", "SetMaterials", "EditMaterial", "ChangeGeometry",
	    "ToggleAlphaTest", "SwapPipeline", "ChangeRayTypes", "Burst", "Purge", "LoseFrame", "DropFrame", "FailAllocation", "ToggleMode",
	    "Corrupt"};
	static_assert(std::size(Names) == static_cast<size_t>(EWalkStep::Count));
	std::string Text;
	for (const FWalkStep& Step : Steps)
	{
		Text += "\n  {EWalkStep::" + std::string(Names[static_cast<size_t>(Step.Kind)]) + ", " + std::to_string(Step.A) + "u, " +
		        std::to_string(Step.B) + "u, " + std::to_string(Step.C) + "u},";
	}
	return Text;
}

} // namespace Lantern
