// Reads types from readelf's print of debug information (DWARF 4).
#include "Layouts.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>
#include <string_view>

#include <cxxabi.h>

namespace Lantern::Abi
{

namespace
{

struct FEntry
{
	std::string Id, Tag;
	std::map<std::string, std::string, std::less<>> Values;
	std::vector<FEntry*> Children;

	std::string Get(std::string_view Name) const
	{
		const auto Found = Values.find(Name);
		return Found == Values.end() ? std::string() : Found->second;
	}
	bool Has(std::string_view Name) const { return Values.find(Name) != Values.end(); }
};

/// "(data1) 64" and "(strp) (offset: 0x61f4b): IRTModule" without what stands before the value.
std::string CutForms(std::string Value)
{
	while (!Value.empty() && Value[0] == '(')
	{
		size_t End = Value.find(')');
		if (End == std::string::npos) { break; }
		++End;
		if (End < Value.size() && Value[End] == ':') { ++End; }
		while (End < Value.size() && (Value[End] == ' ' || Value[End] == '\t')) { ++End; }
		Value.erase(0, End);
	}
	return Value;
}

std::string GetBetween(const std::string& Text, std::string_view Begin, std::string_view End)
{
	const size_t From = Text.find(Begin);
	if (From == std::string::npos) { return {}; }
	const size_t To = Text.find(End, From + Begin.size());
	return Text.substr(From + Begin.size(), To == std::string::npos ? To : To - From - Begin.size());
}

class FReader
{
public:
	explicit FReader(const std::string& DebugInfo) { Read(DebugInfo); }
	void Describe(const FEntry& Scope, const std::string& Path, std::vector<std::string>& Out) const;
	const FEntry& GetRoot() const { return Root; }

private:
	void Read(const std::string& DebugInfo);
	std::string NameType(const FEntry& Of) const;
	std::string NameArray(const FEntry& Array) const;
	std::string DescribeRecord(const FEntry& Type, const std::string& Name) const;
	std::string DescribeEnum(const FEntry& Type, const std::string& Name) const;

	FEntry Root;
	std::map<std::string, std::unique_ptr<FEntry>> Entries;
};

void FReader::Read(const std::string& DebugInfo)
{
	std::vector<FEntry*> Open = {&Root};
	FEntry* Last = nullptr;
	std::istringstream Stream(DebugInfo);
	for (std::string Line; std::getline(Stream, Line);)
	{
		// " <depth><id>: Abbrev Number: n (DW_TAG_…)" begins an entry, "    <id>   DW_AT_… : …" is an attribute.
		if (Line.find(">: Abbrev Number:") != std::string::npos)
		{
			const size_t Depth = std::strtoul(GetBetween(Line, "<", ">").c_str(), nullptr, 10);
			const std::string Tag = GetBetween(Line, "(DW_TAG_", ")");
			if (Tag.empty()) { continue; } // the end of a list
			const std::string Id = GetBetween(Line, "><", ">");
			Last = (Entries[Id] = std::make_unique<FEntry>(FEntry{Id, Tag, {}, {}})).get();
			Open.resize(std::min(Open.size(), Depth + 1));
			Open.back()->Children.push_back(Last);
			Open.push_back(Last);
		}
		else if (const size_t At = Line.find("DW_AT_"); Last != nullptr && At != std::string::npos)
		{
			const size_t Colon = Line.find(':', At);
			std::string Name = Line.substr(At + 6, Colon - At - 6);
			Name.erase(Name.find_last_not_of(' ') + 1);
			const size_t Value = Line.find_first_not_of(' ', Colon + 1);
			Last->Values[Name] = Value == std::string::npos ? std::string() : CutForms(Line.substr(Value));
		}
	}
}

std::string FReader::NameArray(const FEntry& Array) const
{
	std::string Name = NameType(Array);
	for (const FEntry* Range : Array.Children)
	{
		// GCC gives the last index, clang the number.
		const std::string Count = Range->Get("count");
		const unsigned long Last = std::strtoul(Range->Get("upper_bound").c_str(), nullptr, 0);
		Name += "[" + std::to_string(Count.empty() ? Last + 1 : std::strtoul(Count.c_str(), nullptr, 0)) + "]";
	}
	return Name;
}

/// Names the type of a member, parameter or pointer. Basic types are named by kind and size, since compilers spell them differently.
std::string FReader::NameType(const FEntry& Of) const
{
	const auto Found = Entries.find(GetBetween(Of.Get("type"), "<0x", ">"));
	if (Found == Entries.end()) { return "void"; }
	const FEntry& Type = *Found->second;
	if (Type.Tag == "pointer_type") { return NameType(Type) + "*"; }
	if (Type.Tag == "reference_type") { return NameType(Type) + "&"; }
	if (Type.Tag == "const_type") { return "const " + NameType(Type); }
	if (Type.Tag == "array_type") { return NameArray(Type); }
	if (Type.Tag == "typedef") { return NameType(Type); }
	if (Type.Tag == "base_type")
	{
		const char Encoding = Type.Get("encoding").empty() ? '0' : Type.Get("encoding")[0];
		const char* const Kind = Encoding == '2'                      ? "bool"
		                         : Encoding == '4'                    ? "float"
		                         : Encoding == '7' || Encoding == '8' ? "unsigned"
		                                                              : "signed";
		return Kind + std::to_string(8 * std::strtoul(Type.Get("byte_size").c_str(), nullptr, 0));
	}
	if (Type.Tag == "subroutine_type")
	{
		std::string Name = NameType(Type) + "(";
		for (const FEntry* Parameter : Type.Children) { Name += (Parameter == Type.Children.front() ? "" : ", ") + NameType(*Parameter); }
		return Name + ")";
	}
	return Type.Get("name");
}

std::string FReader::DescribeRecord(const FEntry& Type, const std::string& Name) const
{
	std::string Text = "struct " + Name + ", " + Type.Get("byte_size") + " bytes\n";
	for (const FEntry* Child : Type.Children)
	{
		if (Child->Tag == "inheritance") { Text += "  " + Child->Get("data_member_location") + ": base " + NameType(*Child) + "\n"; }
		// Not the table's pointer and not destructors: compilers name them differently, and the other calls' slots show them.
		if (Child->Tag == "member" && Child->Has("data_member_location") && Child->Get("name").rfind("_vptr", 0) != 0)
		{
			Text += "  " + Child->Get("data_member_location") + ": " + NameType(*Child) + " " + Child->Get("name") + "\n";
		}
		if (Child->Tag == "subprogram" && Child->Has("vtable_elem_location") && Child->Get("name")[0] != '~')
		{
			const std::string Linkage = Child->Get("linkage_name");
			int Status = 0;
			const std::unique_ptr<char, decltype(&std::free)> Plain(
			    abi::__cxa_demangle(Linkage.c_str(), nullptr, nullptr, &Status), &std::free);
			const std::string Slot = GetBetween(Child->Get("vtable_elem_location"), "DW_OP_constu: ", ")");
			Text += "  virtual " + Slot + ": " + (Plain ? Plain.get() : Child->Get("name").c_str()) + " -> " + NameType(*Child) + "\n";
		}
	}
	return Text;
}

std::string FReader::DescribeEnum(const FEntry& Type, const std::string& Name) const
{
	std::string Text = "enum " + Name + ", " + Type.Get("byte_size") + " bytes\n";
	for (const FEntry* Child : Type.Children) { Text += "  " + Child->Get("name") + " = " + Child->Get("const_value") + "\n"; }
	return Text;
}

void FReader::Describe(const FEntry& Scope, const std::string& Path, std::vector<std::string>& Out) const
{
	for (const FEntry* Child : Scope.Children)
	{
		const std::string Name = Path + Child->Get("name");
		const bool bWhole = Child->Has("name") && !Child->Has("declaration") && Name.find('<') == std::string::npos;
		if (Child->Tag == "namespace") { Describe(*Child, Name + "::", Out); }
		if (!bWhole) { continue; }
		if (Child->Tag == "enumeration_type") { Out.push_back(DescribeEnum(*Child, Name)); }
		if (Child->Tag == "structure_type" || Child->Tag == "class_type")
		{
			Out.push_back(DescribeRecord(*Child, Name));
			Describe(*Child, Name + "::", Out);
		}
	}
}

} // namespace

std::vector<std::string> DescribeLayouts(const std::string& DebugInfo, const std::string& Namespace)
{
	const FReader Reader(DebugInfo);
	std::vector<std::string> Out;
	for (const FEntry* Unit : Reader.GetRoot().Children)
	{
		for (const FEntry* Child : Unit->Children)
		{
			if (Child->Tag == "namespace" && Child->Get("name") == Namespace) { Reader.Describe(*Child, "", Out); }
		}
	}
	std::sort(Out.begin(), Out.end());
	return Out;
}

std::vector<std::string> DescribeObject(const std::string& ObjectFile, const std::string& Namespace)
{
	const std::string Command = "readelf --debug-dump=info --wide \"" + ObjectFile + "\"";
	const std::unique_ptr<FILE, decltype(&pclose)> Pipe(popen(Command.c_str(), "r"), &pclose);
	std::string Text;
	char Block[65536];
	while (Pipe)
	{
		const size_t Count = std::fread(Block, 1, sizeof(Block), Pipe.get());
		if (Count == 0) { break; }
		Text.append(Block, Count);
	}
	return DescribeLayouts(Text, Namespace);
}

} // namespace Lantern::Abi
