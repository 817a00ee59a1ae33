// FInstanceStore: the trees that find the bucket for an object, and the groups. Each cell, level of size and group has a k-d
// tree whose leaves are buckets. A full bucket is split at the median of its longest side.
#include <algorithm>
#include <array>

#include "LanternScene/Instances/InstanceStore.h"

namespace Lantern
{

namespace
{
constexpr uint32_t NoNode = ~0u;
/// Two sibling leaves that have no more objects than this together become one bucket.
constexpr uint32_t MergeCount = 40;

float* AxisOf(FInstanceBucket& Bucket, int32_t Axis) { return Axis == 0 ? Bucket.X : Axis == 1 ? Bucket.Y : Bucket.Z; }

/// Finds the longest side of the objects' bounds and where to cut it. Returns false if all objects are in one place.
bool ChooseCut(FInstanceBucket& Bucket, int32_t& OutAxis, float& OutSplit)
{
	float Longest = 0.0f;
	for (int32_t Axis = 0; Axis < 3; ++Axis)
	{
		const float* const At = AxisOf(Bucket, Axis);
		const auto [Min, Max] = std::minmax_element(At, At + Bucket.Count);
		if (*Max - *Min > Longest)
		{
			Longest = *Max - *Min;
			OutAxis = Axis;
		}
	}
	if (!(Longest > 0.0f)) { return false; }
	std::array<float, FInstanceBucket::Capacity> Sorted{};
	std::copy_n(AxisOf(Bucket, OutAxis), Bucket.Count, Sorted.begin());
	std::sort(Sorted.begin(), Sorted.begin() + Bucket.Count);
	OutSplit = Sorted[Bucket.Count / 2];
	if (OutSplit <= Sorted[0]) { OutSplit = *std::upper_bound(Sorted.begin(), Sorted.begin() + Bucket.Count, Sorted[0]); }
	return true;
}
} // namespace

uint32_t FInstanceStore::AllocateNode()
{
	if (FreeNodes.empty())
	{
		Nodes.emplace_back();
		return static_cast<uint32_t>(Nodes.size()) - 1;
	}
	const uint32_t Node = FreeNodes.back();
	FreeNodes.pop_back();
	Nodes[Node] = {};
	return Node;
}

uint32_t FInstanceStore::FindLeaf(const FKey& Key, const glm::vec3& At)
{
	const auto [Found, bNew] = Roots.try_emplace(Key, NoNode);
	if (bNew)
	{
		Found->second = AllocateNode();
		Nodes[Found->second].Child[0] = AllocateBucket(Key, Found->second);
	}
	uint32_t Node = Found->second;
	while (Nodes[Node].Axis >= 0) { Node = Nodes[Node].Child[At[Nodes[Node].Axis] < Nodes[Node].Split ? 0 : 1]; }
	return Nodes[Node].Child[0];
}

void FInstanceStore::Split(uint32_t Index)
{
	const FKey Key{Buckets[Index]->Cell, Buckets[Index]->Level, Buckets[Index]->Group};
	const uint32_t Node = Buckets[Index]->Node;
	int32_t Axis = -1;
	float Cut = 0.0f;
	if (!ChooseCut(*Buckets[Index], Axis, Cut))
	{
		// All objects are in one place: the full bucket leaves the tree, and a fresh one takes its leaf.
		Buckets[Index]->Node = NoNode;
		Nodes[Node].Child[0] = AllocateBucket(Key, Node);
		return;
	}
	const uint32_t Low = AllocateNode(), High = AllocateNode();
	const uint32_t Other = AllocateBucket(Key, High);
	FInstanceBucket& Bucket = *Buckets[Index];
	Bucket.Node = Low;
	Nodes[Low].Child[0] = Index;
	Nodes[High].Child[0] = Other;
	Nodes[Low].Parent = Nodes[High].Parent = Node;
	Nodes[Node].Axis = Axis;
	Nodes[Node].Split = Cut;
	Nodes[Node].Child[0] = Low;
	Nodes[Node].Child[1] = High;
	for (uint32_t Lane = 0; Lane < Bucket.Count;)
	{
		if (AxisOf(Bucket, Axis)[Lane] < Cut)
		{
			++Lane;
			continue;
		}
		MoveLane(Bucket, Lane, Other);
		const uint32_t Last = --Bucket.Count;
		if (Lane == Last) { break; }
		const uint32_t Moved = Bucket.Object(Last);
		WriteLane(Bucket, Lane, Moved, Bucket.Transform[Last], {Bucket.X[Last], Bucket.Y[Last], Bucket.Z[Last]});
		Records[Moved].Lane = static_cast<uint8_t>(Lane);
	}
	MarkDirty(Index);
}

/// Moves Kept, a child of Parent, to the place of Parent.
void FInstanceStore::Collapse(uint32_t Parent, uint32_t Kept, uint32_t Dropped)
{
	FNode Node = Nodes[Kept];
	Node.Parent = Nodes[Parent].Parent;
	Nodes[Parent] = Node;
	if (Node.Axis < 0) { Buckets[Node.Child[0]]->Node = Parent; }
	else { Nodes[Node.Child[0]].Parent = Nodes[Node.Child[1]].Parent = Parent; }
	FreeNodes.push_back(Kept);
	FreeNodes.push_back(Dropped);
}

void FInstanceStore::RemoveLeaf(uint32_t Index)
{
	const FInstanceBucket& Bucket = *Buckets[Index];
	const uint32_t Leaf = Bucket.Node, Parent = Nodes[Leaf].Parent;
	if (Parent == NoNode)
	{
		Roots.erase(FKey{Bucket.Cell, Bucket.Level, Bucket.Group});
		FreeNodes.push_back(Leaf);
		return;
	}
	Collapse(Parent, Nodes[Parent].Child[Nodes[Parent].Child[0] == Leaf ? 1 : 0], Leaf);
}

void FInstanceStore::MergeWithSibling(uint32_t Index)
{
	const uint32_t Leaf = Buckets[Index]->Node, Parent = Nodes[Leaf].Parent;
	if (Parent == NoNode) { return; }
	const uint32_t Sibling = Nodes[Parent].Child[Nodes[Parent].Child[0] == Leaf ? 1 : 0];
	if (Nodes[Sibling].Axis >= 0) { return; }
	const uint32_t Other = Nodes[Sibling].Child[0];
	if (Buckets[Index]->Count + Buckets[Other]->Count > MergeCount) { return; }
	FInstanceBucket& From = *Buckets[Index];
	for (uint32_t Lane = 0; Lane < From.Count; ++Lane) { MoveLane(From, Lane, Other); }
	Collapse(Parent, Sibling, Leaf);
	FreeBucket(Index);
}

// ---------------------------------------------------------------------------------------------------- groups

uint32_t FInstanceStore::FindGroup(uint32_t Name)
{
	if (Name == 0) { return 0; }
	const auto [Found, bNew] = GroupsByName.try_emplace(Name, 0);
	if (!bNew) { return Found->second; }
	if (FreeGroups.empty())
	{
		Found->second = static_cast<uint32_t>(Groups.size());
		Groups.emplace_back();
		GroupNames.push_back(Name);
	}
	else
	{
		Found->second = FreeGroups.back();
		FreeGroups.pop_back();
		GroupNames[Found->second] = Name;
	}
	return Found->second;
}

void FInstanceStore::MarkGroupDirty(uint32_t Index)
{
	if (Index == 0 || Groups[Index].bDirty) { return; }
	Groups[Index].bDirty = true;
	DirtyGroups.push_back(Index);
}

void FInstanceStore::JoinGroup(uint32_t Object)
{
	const uint32_t Index = Records[Object].Group;
	if (Index == 0) { return; }
	Records[Object].Member = static_cast<uint32_t>(Groups[Index].Members.size());
	Groups[Index].Members.push_back(Object);
	MarkGroupDirty(Index);
}

void FInstanceStore::LeaveGroup(uint32_t Object)
{
	const uint32_t Index = Records[Object].Group;
	if (Index == 0) { return; }
	FInstanceGroup& Group = Groups[Index];
	const uint32_t Last = Group.Members.back();
	Group.Members[Records[Object].Member] = Last;
	Records[Last].Member = Records[Object].Member;
	Group.Members.pop_back();
	if (!Group.Members.empty()) { return MarkGroupDirty(Index); }
	GroupsByName.erase(GroupNames[Index]);
	GroupNames[Index] = 0;
	Group = {};
	FreeGroups.push_back(Index);
}

void FInstanceStore::RefreshGroup(FInstanceGroup& Group)
{
	Group.bDirty = false;
	glm::dvec3 Min(1e300), Max(-1e300);
	for (const uint32_t Object : Group.Members)
	{
		Min = glm::min(Min, Records[Object].Center - Records[Object].Radius);
		Max = glm::max(Max, Records[Object].Center + Records[Object].Radius);
	}
	Group.Center = 0.5 * (Min + Max);
	Group.Radius = 0.0;
	for (const uint32_t Object : Group.Members)
	{
		const FInstanceRecord& Record = Records[Object];
		Group.Radius = std::max(Group.Radius, glm::distance(Group.Center, Record.Center) + Record.Radius);
	}
	// One member without bounds keeps the whole group.
	if (Group.Radius >= UnboundedRadius) { Group.Radius = UnboundedRadius; }
}

} // namespace Lantern
