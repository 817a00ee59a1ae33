// How a scene moves to another device: all that lives is said again, from the handles, the old scene and what no frame has taken.
#include <algorithm>
#include <iterator>
#include <type_traits>
#include <utility>

#include "LandscapePatch.h"
#include "LanternCore/Text/Log.h"
#include "LanternCore/Text/Quote.h"
#include "LanternRHI/RTText.h"
#include "SceneCalls.h"

namespace Lantern
{

namespace
{

template <class T>
T& GetSlot(std::vector<T>& Values, uint32_t Slot)
{
	if (Slot >= Values.size()) { Values.resize(Slot + 1); }
	return Values[Slot];
}

template <class T>
std::optional<T> FindSlot(const std::vector<std::optional<T>>& Values, uint32_t Slot)
{
	return Slot < Values.size() ? Values[Slot] : std::nullopt;
}

/// A command without a value that only the scene knows. A new kind of command must be named here or followed.
template <class T>
constexpr bool HasNoValue =
    std::is_same_v<T, FAddMeshCommand> || std::is_same_v<T, FRemoveMeshCommand> || std::is_same_v<T, FRemoveObjectCommand> ||
    std::is_same_v<T, FMaskCommand> || std::is_same_v<T, FChannelsCommand> || std::is_same_v<T, FToonCommand> ||
    std::is_same_v<T, FProfileCommand> || std::is_same_v<T, FObjectMaterialsCommand> || std::is_same_v<T, FVerticesCommand> ||
    std::is_same_v<T, FDeformedCommand>;

struct FFollower
{
	FSceneValues& Values;

	void operator()(const FMaterialCommand& Command)
	{
		GetSlot(Values.Materials, Command.Slot) = Command.Data ? std::optional(*Command.Data) : std::nullopt;
	}
	void operator()(const FAddObjectCommand& Command) { GetSlot(Values.Transforms, Command.Slot) = Command.Transform; }
	void operator()(const FTransformCommand& Command) { GetSlot(Values.Transforms, Command.Slot) = Command.Transform; }
	void operator()(const FLightCommand& Command) { GetSlot(Values.Lights, Command.Slot) = Command.Light; }
	void operator()(const FSunLight& Command) { Values.Sun = Command; }
	void operator()(const FSkyCommand& Command) { Values.Sky = Command.Radiance; }
	void operator()(const FSkyProgramCommand& Command) { Values.SkyProgram = Command.Program; }
	void operator()(const FObjectMeshCommand&) {}
	void operator()(const FSkyMapCommand&) {} // its texture goes with the old device
	template <class T>
	requires HasNoValue<T>
	void operator()(const T&) {}
};

} // namespace

void FSceneValues::Follow(const FSceneCommand& Command) { std::visit(FFollower{*this}, Command); }

FRTStatus FSceneCalls::MakeAgain(
    IRTDevice& On, FBufferUploads& By, const FRTModuleMesh& Given, const FMesh& Old, FMesh& Out, FAddMeshCommand& OutCommand)
{
	if (const FRTStatus Status = MakeMesh(On, By, Given, Out, OutCommand); !Status) { return Status; }
	if (Out.IsOpaque == Old.IsOpaque && Out.bDeformable == Old.bDeformable) { return FRTStatus::Success(); }
	return FRTStatus::Error(ERTResult::InvalidArgument, "Recreate: mesh \"%s\" was given with other sections or another bDeformable",
	    FRTShown(Old.Name.c_str()).Text);
}

FRTStatus FSceneCalls::TakeOver(IRTDevice& NewDevice, FBufferUploads& NewUploads, const FRTModuleMeshSource& Source, FSceneValues Values)
{
	std::unique_lock DeviceLock(DeviceMutex);
	std::lock_guard Lock(Mutex);
	struct FAgain
	{
		FMesh* Old = nullptr;
		FMesh New;
		FAddMeshCommand Command;
	};
	std::vector<FAgain> Again;
	FRTStatus Status;
	Meshes.ForEach([&](ERTMeshHandle Handle, FMesh& Mesh) {
		FRTModuleMesh Given;
		if (!Status) { return; }
		FAgain& Item = Again.emplace_back();
		Item.Old = &Mesh;
		Item.Command.Slot = Meshes.GetSlot(Handle);
		if (Mesh.Landscape)
		{
			Item.New.Landscape = Mesh.Landscape;
			Status = MakeAgain(NewDevice, NewUploads, Mesh.Landscape->MakeMesh(), Mesh, Item.New, Item.Command);
			return;
		}
		if (Source.Get != nullptr && Source.Get(Source.User, Handle, &Given))
		{
			Status = MakeAgain(NewDevice, NewUploads, Given, Mesh, Item.New, Item.Command);
			return;
		}
		LogWarning("Recreate: mesh \"{}\" was not given again: its objects are not seen", EscapeText(Mesh.Name, MaxQuotedBytes));
	});
	if (!Status) { return Status; }

	// Nothing fails from here on.
	for (const FSceneCommand& Command : Updates) { Values.Follow(Command); }
	for (const FSceneCommand& Command : Arrivals) { Values.Follow(Command); }
	Updates.clear();
	LastTaken += Arrivals.size(); // what waited for them need not
	Arrivals.clear();
	Device = &NewDevice;
	Uploads = &NewUploads;
	for (FAgain& Item : Again)
	{
		Item.Old->Upload = Item.New.Upload;
		if (Item.Command.Info)
		{
			Item.Old->Deformable = std::move(Item.New.Deformable);
			Item.Old->bHasBounds = Item.New.bHasBounds;
			Item.Old->bStreamed = Item.New.bStreamed;
		}
		Item.Old->Ticket = AddArrival(std::move(Item.Command));
	}
	AddAll(Values);
	return Status;
}

/// Materials, objects, profiles and lights, after the meshes.
void FSceneCalls::AddAll(const FSceneValues& Values)
{
	Materials.ForEach([&](ERTMaterialHandle Handle, FMaterial& Material) {
		const uint32_t Slot = Materials.GetSlot(Handle);
		auto Data = std::make_unique<FMaterialData>(*FindSlot(Values.Materials, Slot)); // each that lives has had a command
		std::fill(std::begin(Data->Textures), std::end(Data->Textures), NO_TEXTURE);
		Material.Textures = {};
		Material.Ticket = AddArrival(FMaterialCommand{Slot, std::move(Data), {}});
	});
	Objects.ForEach([&](ERTObjectHandle Handle, FObject& Object) {
		FAddObjectCommand Command;
		Command.Slot = Objects.GetSlot(Handle);
		Command.Materials = GetSlots(Object.Materials);
		Command.Mask = MakeObjectMask(Object.Traits);
		Command.bCharacter = Object.Traits.bCharacter;
		Command.Channels = Object.Traits.Channels;
		Command.Toon = Object.Toon;
		// An object whose mesh could not be made was never placed, and stays unseen.
		const std::optional<glm::dmat4> Transform = FindSlot(Values.Transforms, Command.Slot);
		Command.Mesh = Transform ? Meshes.GetSlot(Object.Mesh) : ~0u;
		Command.Transform = Transform.value_or(glm::dmat4(1.0));
		Object.Ticket = AddArrival(std::move(Command));
	});
	Profiles.ForEach([&](ERTIesHandle Handle, FProfile& Profile) {
		Profile.Ticket = AddArrival(FProfileCommand{Profiles.GetSlot(Handle), Profile.Grid});
	});
	Lights.ForEach([&](ERTLightHandle Handle, FLight& Light) {
		std::optional<FSceneLight> Value = FindSlot(Values.Lights, Lights.GetSlot(Handle));
		const bool bProfile = Value && Light.Profile != ERTIesHandle::None;
		if (Value) { Value->Profile = bProfile ? Profiles.GetSlot(Light.Profile) + 1 : 0; } // it was a number of the old scene
		Light.Ticket = AddArrival(FLightCommand{Lights.GetSlot(Handle), std::move(Value)});
	});
	Updates.emplace_back(Values.Sun);
	Updates.emplace_back(FSkyCommand{Values.Sky});
	Updates.emplace_back(FSkyProgramCommand{Values.SkyProgram});
	SkyTextures = {};
}

} // namespace Lantern
