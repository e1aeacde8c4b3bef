"""The paper's claims about its three agents: what is measured for each, and the test."""
