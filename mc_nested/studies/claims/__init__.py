"""The paper's claims, about its three agents and beyond them: what is measured for each, and how it is tested."""
