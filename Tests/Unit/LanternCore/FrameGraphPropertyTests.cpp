// The frame graph under random graphs: everything it decides is checked against brute force.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "FrameGraphTestBase.h"

namespace Lantern
{
namespace
{

constexpr ERTAccess TextureReads[] = {ERTAccess::ShaderRead, ERTAccess::StorageRead, ERTAccess::CopyRead};
constexpr ERTAccess TextureWrites[] = {ERTAccess::StorageWrite, ERTAccess::RenderTarget, ERTAccess::CopyWrite};
constexpr ERTAccess BufferReads[] = {ERTAccess::ShaderRead, ERTAccess::IndirectRead, ERTAccess::CopyRead, ERTAccess::IndexRead};
constexpr ERTAccess BufferWrites[] = {ERTAccess::StorageWrite, ERTAccess::CopyWrite};

bool Writes(ERTAccess Access)
{
	return HasAny(
	    Access, ERTAccess::StorageWrite | ERTAccess::RenderTarget | ERTAccess::CopyWrite | ERTAccess::DepthWrite | ERTAccess::BuildWrite);
}

/// As a backend chooses it: storage is general, everything else has its own.
int Layout(bool bTexture, ERTAccess Access)
{
	if (!bTexture) { return 0; }
	const uint32_t Bits = static_cast<uint32_t>(Access);
	const bool bGeneral = HasAny(Access, ERTAccess::StorageRead | ERTAccess::StorageWrite) || (Bits & (Bits - 1)) != 0;
	return bGeneral ? -1 : static_cast<int>(Bits);
}

struct FRandomResource
{
	std::string Name;
	bool bTexture = false, bImported = false;
	uint32_t Size = 0;
	ERTAccess Current = ERTAccess::None, After = ERTAccess::None;
	size_t Native = 0; ///< imported: which
	FGraphTexture Texture;
	FGraphBuffer Buffer;
};

struct FRandomUse
{
	size_t Resource = 0;
	ERTAccess Read = ERTAccess::None, Write = ERTAccess::None;
};

struct FRandomPass
{
	std::string Name;
	std::vector<FRandomUse> Uses;
	bool bNeverCull = false, bGroup = false;
};

/// One access or one barrier of one native resource, in the order of the command list.
struct FEvent
{
	bool bBarrier = false;
	ERTAccess Access = ERTAccess::None; ///< of a barrier: before
	ERTAccess After = ERTAccess::None;
};

struct FTimeline
{
	bool bTexture = false;
	std::vector<FEvent> Events;
};

class FrameGraphPropertyTest : public FFrameGraphTestBase
{
protected:
	void Generate(uint32_t Seed)
	{
		Random.seed(Seed);
		Resources_.clear();
		Passes_.clear();
		const size_t Count = 2 + Random() % 10;
		for (size_t I = 0; I < Count; ++I)
		{
			FRandomResource& R = Resources_.emplace_back();
			R.bTexture = Random() % 2;
			R.bImported = Random() % 4 == 0;
			R.Size = Random() % 2 ? 16 : 32; // few sizes: much reuse
			R.Name = (R.bImported ? "I" : "T") + std::to_string(I);
			if (R.bImported)
			{
				R.Current = PickState(R.bTexture);
				R.After = Random() % 2 ? PickState(R.bTexture) : ERTAccess::None;
			}
		}
		std::set<size_t> Written;
		const size_t PassCount = 1 + Random() % 20;
		for (size_t I = 0; I < PassCount; ++I) { GeneratePass(I, Written); }
	}
	ERTAccess PickState(bool bTexture)
	{
		// Never None for a texture: reading it must be allowed.
		const ERTAccess Choices[] = {
		    ERTAccess::ShaderRead, ERTAccess::StorageWrite, ERTAccess::CopyRead, bTexture ? ERTAccess::RenderTarget : ERTAccess::None};
		return Choices[Random() % 4];
	}
	void GeneratePass(size_t Index, std::set<size_t>& Written)
	{
		FRandomPass& Pass = Passes_.emplace_back();
		Pass.Name = "P" + std::to_string(Index);
		Pass.bNeverCull = Random() % 12 == 0;
		Pass.bGroup = Random() % 3 == 0;
		const size_t Uses = 1 + Random() % 4;
		std::set<size_t> Mine;
		for (size_t U = 0; U < Uses; ++U)
		{
			FRandomUse Use;
			Use.Resource = Random() % Resources_.size();
			if (!Mine.insert(Use.Resource).second) { continue; }
			const FRandomResource& R = Resources_[Use.Resource];
			const bool bReadable = R.bImported || Written.count(Use.Resource) > 0;
			const uint32_t Kind = bReadable ? Random() % 5 : 4;
			if (Kind == 0) // read-modify-write
			{
				Use.Read = ERTAccess::StorageRead;
				Use.Write = ERTAccess::StorageWrite;
			}
			else if (Kind <= 3) { Use.Read = R.bTexture ? TextureReads[Random() % 3] : BufferReads[Random() % 4]; }
			else { Use.Write = R.bTexture ? TextureWrites[Random() % 3] : BufferWrites[Random() % 2]; }
			Pass.Uses.push_back(Use);
		}
		for (const FRandomUse& Use : Pass.Uses)
		{
			if (Use.Write != ERTAccess::None) { Written.insert(Use.Resource); }
		}
	}

	/// Which passes must run, by growing the set until nothing changes.
	std::set<std::string> BruteForceAlive() const
	{
		std::vector<bool> Alive(Passes_.size(), false);
		for (bool bChanged = true; bChanged;)
		{
			bChanged = false;
			for (size_t I = 0; I < Passes_.size(); ++I)
			{
				if (!Alive[I] && MustRun(I, Alive)) { Alive[I] = bChanged = true; }
			}
		}
		std::set<std::string> Names;
		for (size_t I = 0; I < Passes_.size(); ++I)
		{
			if (Alive[I]) { Names.insert(Passes_[I].Name); }
		}
		return Names;
	}
	bool MustRun(size_t Index, const std::vector<bool>& Alive) const
	{
		bool bMust = Passes_[Index].bNeverCull;
		for (const FRandomUse& Mine : Passes_[Index].Uses)
		{
			if (Mine.Write == ERTAccess::None) { continue; }
			bMust |= Resources_[Mine.Resource].bImported;
			for (size_t Later = Index + 1; Later < Passes_.size(); ++Later)
			{
				for (const FRandomUse& Use : Passes_[Later].Uses)
				{
					bMust |= Alive[Later] && Use.Resource == Mine.Resource && Use.Read != ERTAccess::None;
				}
			}
		}
		return bMust;
	}

	void Declare(FFrameGraph& Graph, bool bFirstFrame)
	{
		for (FRandomResource& R : Resources_)
		{
			if (R.bImported && bFirstFrame)
			{
				R.Native = R.bTexture ? Held.size() : HeldBuffers.size();
				R.bTexture ? (void)(R.Texture = ImportTexture(Graph, R.Name.c_str(), R.Current, R.After))
				           : (void)(R.Buffer = ImportBuffer(Graph, R.Name.c_str(), R.Current, R.After));
			}
			else if (R.bImported)
			{
				R.bTexture ? (void)(R.Texture = Graph.ImportTexture(Held[R.Native].Get(), R.Current, R.After, R.Name.c_str()))
				           : (void)(R.Buffer = Graph.ImportBuffer(HeldBuffers[R.Native].Get(), R.Current, R.After, R.Name.c_str()));
			}
			else { DeclareTransient(Graph, R); }
		}
		for (const FRandomPass& Pass : Passes_)
		{
			Graph.AddPass(Pass.Name.c_str(), [&](FPassBuilder& Builder) -> FPassExecute {
				for (const FRandomUse& Use : Pass.Uses) { DeclareUse(Builder, Use); }
				if (Pass.bGroup) { Builder.RunBeside("Group"); }
				if (Pass.bNeverCull) { Builder.NeverCull(); }
				return [this, &Pass](FPassContext& Context) { NoteAccesses(Context, Pass); };
			});
		}
	}
	static void DeclareTransient(FFrameGraph& Graph, FRandomResource& R)
	{
		// All usages, so that descriptions are often equal and memory is often shared.
		if (R.bTexture)
		{
			const ERTTextureUsage All = ERTTextureUsage::Sampled | ERTTextureUsage::Storage | ERTTextureUsage::RenderTarget |
			                            ERTTextureUsage::CopySource | ERTTextureUsage::CopyDest;
			R.Texture = Graph.CreateTexture({R.Size, R.Size, ERTFormat::R32_FLOAT, All, 1}, R.Name.c_str());
			return;
		}
		const ERTBufferUsage All = ERTBufferUsage::Storage | ERTBufferUsage::Index | ERTBufferUsage::Indirect | ERTBufferUsage::CopySource |
		                           ERTBufferUsage::CopyDest;
		R.Buffer = Graph.CreateBuffer({256, All}, R.Name.c_str());
	}
	void DeclareUse(FPassBuilder& Builder, const FRandomUse& Use) const
	{
		const FRandomResource& R = Resources_[Use.Resource];
		if (Use.Read != ERTAccess::None) { R.bTexture ? Builder.Read(R.Texture, Use.Read) : Builder.Read(R.Buffer, Use.Read); }
		if (Use.Write != ERTAccess::None) { R.bTexture ? Builder.Write(R.Texture, Use.Write) : Builder.Write(R.Buffer, Use.Write); }
	}

	/// Runs inside a pass: the barriers recorded so far come first, then what the pass does with whom.
	void NoteAccesses(FPassContext& Context, const FRandomPass& Pass)
	{
		Ran.push_back(Pass.Name);
		NoteBarriers();
		for (const FRandomUse& Use : Pass.Uses)
		{
			const FRandomResource& R = Resources_[Use.Resource];
			const std::string Native =
			    R.bTexture ? Context.GetTexture(R.Texture)->GetDesc().Name : Context.GetBuffer(R.Buffer)->GetDesc().Name;
			Timelines[Native].bTexture = R.bTexture;
			Timelines[Native].Events.push_back({false, Use.Read | Use.Write, ERTAccess::None});
			Tenants[Native].push_back({Use.Resource, Ran.size()});
		}
	}
	void NoteBarriers()
	{
		const std::vector<FRTMockCall> Calls = Mock().FindCalls(ERTMockCall::Barrier);
		for (; SeenBarriers < Calls.size(); ++SeenBarriers)
		{
			const FRTMockCall& Call = Calls[SeenBarriers];
			Timelines[Call.Name].Events.push_back({true, static_cast<ERTAccess>(Call.Numbers[0]), static_cast<ERTAccess>(Call.Numbers[1])});
		}
	}

	/// Is everything that A did over and visible before B? Each barrier on the way must wait for what stood before
	/// it and lead to what stands behind it.
	static bool IsOrdered(const FTimeline& Line, size_t A, size_t B)
	{
		ERTAccess Waiting = Line.Events[A].Access;
		bool bAny = false;
		for (size_t I = A + 1; I < B; ++I)
		{
			const FEvent& Event = Line.Events[I];
			if (Event.bBarrier)
			{
				if ((Event.Access & Waiting) != Waiting) { return false; }
				Waiting = Event.After;
				bAny = true;
			}
		}
		return bAny && (Waiting & Line.Events[B].Access) == Line.Events[B].Access;
	}
	static void CheckHazards(const std::string& Name, const FTimeline& Line)
	{
		for (size_t B = 0; B < Line.Events.size(); ++B)
		{
			for (size_t A = 0; A < B && !Line.Events[B].bBarrier; ++A)
			{
				const FEvent &First = Line.Events[A], &Second = Line.Events[B];
				if (First.bBarrier || First.Access == ERTAccess::None) { continue; }
				if (Writes(First.Access) || Writes(Second.Access))
				{
					ASSERT_TRUE(IsOrdered(Line, A, B)) << Name << ": " << AccessText(static_cast<uint64_t>(First.Access)) << " then "
					                                   << AccessText(static_cast<uint64_t>(Second.Access));
				}
			}
		}
	}
	/// Every access finds the layout it needs, every barrier starts from the layout that is there, and none is idle.
	static void CheckStates(const std::string& Name, const FTimeline& Line)
	{
		ERTAccess State = ERTAccess::None;
		bool bFresh = true; // a buffer never used before enters its first state, reads taken together, unasked
		for (const FEvent& Event : Line.Events)
		{
			bFresh = bFresh && !Event.bBarrier;
			if (!Event.bBarrier)
			{
				State = bFresh ? State | Event.Access : State;
				ASSERT_EQ(Layout(Line.bTexture, State), Layout(Line.bTexture, Event.Access)) << Name;
				continue;
			}
			ASSERT_EQ(Event.Access, State) << Name << ": a barrier starts from another state than there is";
			const bool bReadToRead = !Writes(Event.Access) && !Writes(Event.After) && Event.Access != ERTAccess::None;
			const bool bIdle = bReadToRead && Event.Access == Event.After;
			ASSERT_FALSE(bIdle) << Name << ": a barrier between equal reads";
			State = Event.After;
		}
	}
	/// Imported resources with After end in it; the others say where they are for the next frame.
	void CheckImportedStates()
	{
		for (FRandomResource& R : Resources_)
		{
			if (!R.bImported) { continue; }
			ERTAccess State = R.Current;
			bool bFresh = true;
			for (const FEvent& Event : Timelines[R.Name].Events)
			{
				bFresh = bFresh && !Event.bBarrier;
				State = Event.bBarrier ? Event.After : bFresh ? State | Event.Access : State;
			}
			const bool bUntouchedBuffer = State == ERTAccess::None && !R.bTexture;
			if (R.After != ERTAccess::None && !bUntouchedBuffer) { ASSERT_EQ(State, R.After) << R.Name; }
			R.Current = State;
		}
	}
	/// Passes of a group move, but none past another that it needs, or that needs it.
	void CheckOrder()
	{
		for (size_t Later = 0; Later < Ran.size(); ++Later)
		{
			for (size_t Earlier = 0; Earlier < Later; ++Earlier)
			{
				const size_t A = std::stoul(Ran[Earlier].substr(1)), B = std::stoul(Ran[Later].substr(1));
				if (A < B) { continue; }
				++Swapped;
				for (const FRandomUse& Use : Passes_[A].Uses)
				{
					for (const FRandomUse& Other : Passes_[B].Uses)
					{
						const bool bWrite = Use.Write != ERTAccess::None || Other.Write != ERTAccess::None;
						ASSERT_FALSE(Use.Resource == Other.Resource && bWrite) << Ran[Earlier] << " ran before " << Ran[Later];
					}
				}
			}
		}
	}
	void CheckTenants() const
	{
		for (const auto& [Native, Uses] : Tenants)
		{
			std::map<size_t, std::pair<size_t, size_t>> Spans;
			for (const auto& [Resource, Pass] : Uses)
			{
				const auto [It, bNew] = Spans.try_emplace(Resource, Pass, Pass);
				It->second.second = Pass;
			}
			for (const auto& A : Spans)
			{
				for (const auto& B : Spans)
				{
					const bool bApart = A.second.second < B.second.first || B.second.second < A.second.first;
					ASSERT_TRUE(A.first == B.first || bApart) << Native << " has two tenants at once";
				}
			}
		}
	}

	std::mt19937 Random;
	std::vector<FRandomResource> Resources_;
	std::vector<FRandomPass> Passes_;
	std::map<std::string, FTimeline> Timelines;
	std::map<std::string, std::vector<std::pair<size_t, size_t>>> Tenants; ///< native: (resource, pass)
	size_t SeenBarriers = 0;
	size_t Swapped = 0; ///< pairs of passes that ran in another order than they were declared in
};

TEST_F(FrameGraphPropertyTest, AThousandRandomGraphsHaveNoHazard)
{
	size_t Executed = 0, Culled = 0, Shared = 0;
	for (uint32_t Seed = 0; Seed < 1000; ++Seed)
	{
		SCOPED_TRACE("seed " + std::to_string(Seed));
		Generate(Seed);
		Clear();
		MakeDevice();
		Timelines.clear();
		SeenBarriers = 0;
		for (const FRandomResource& R : Resources_)
		{
			if (R.bImported) { Timelines[R.Name] = {R.bTexture, {{false, R.Current, ERTAccess::None}}}; }
		}
		// The second frame meets the resources as the first left them.
		for (int Frame = 0; Frame < 2; ++Frame)
		{
			Tenants.clear();
			FFrameGraph Graph(*Resources);
			Declare(Graph, Frame == 0);
			Run(Graph);
			NoteBarriers();
			ASSERT_EQ(std::set<std::string>(Ran.begin(), Ran.end()), BruteForceAlive()) << Graph.Dump();
			CheckOrder();
			CheckTenants();
			for (auto& [Name, Line] : Timelines)
			{
				CheckHazards(Name, Line);
				CheckStates(Name, Line);
				ASSERT_FALSE(HasFatalFailure()) << Graph.Dump();
			}
			CheckImportedStates();
			Executed += Ran.size();
			Culled += Graph.GetCulledPassCount();
		}
		for (const auto& [Native, Uses] : Tenants)
		{
			std::set<size_t> Who;
			std::transform(Uses.begin(), Uses.end(), std::inserter(Who, Who.end()), [](const auto& U) { return U.first; });
			Shared += Who.size() > 1 ? 1 : 0;
		}
		EXPECT_EQ(Mock().GetErrors(), std::vector<std::string>());
	}
	// The generator must reach what the test is about.
	EXPECT_GT(Executed, 5000u);
	EXPECT_GT(Culled, 2000u);
	EXPECT_GT(Shared, 150u);
	EXPECT_GT(Swapped, 200u);
}

} // namespace
} // namespace Lantern
